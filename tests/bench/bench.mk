# bench.mk - instructions per ray, path and warp; ratios to float on this PC
# SPDX-License-Identifier: MIT

bench_obj := $(addprefix tests/bench/rays/,bench_pc.o bench_rays.o float_pt.o)
$(bench_obj:%=$O/fine/%) $(bench_obj:%=$O/draft/%): \
    HOST += -fno-math-errno

$O/bench-pc: $(bench_obj:%=$O/fine/%) $(fine)
	$(link)

$O/bench-pc-draft: $(bench_obj:%=$O/draft/%) $(draft)
	$(link)

$O/bench-pc $O/bench-pc-draft $O/make-mesh $O/make-tables $O/warps-pc \
    $O/warps-pc-draft: $O/flags/link

$O/make-mesh: $O/host/tests/bench/rays/make_mesh.o
	$(link)

# A pattern of one file makes both at once: % is the dot.
$O/mesh%qlb $O/mesh%h: $O/make-mesh $O/qlux-scene
	$(call step,SCENE,$O/mesh.qlb)$O/make-mesh $O && $O/qlux-scene \
	    $O/mesh.scene -o $O/mesh.qlb --features $O/mesh.h --quiet

# Warps: the same list of calls in a firmware and in a program.

$O/make-tables: $O/host/tests/bench/warps/make_tables.o $(io)
	$(link)

$O/bench_tables.h: $O/make-tables
	$(call step,TABLES,$@)$< -o $@

warps_obj := $(addprefix tests/bench/warps/,warps_pc.o warp_list.o)
warps_obj_both := $(warps_obj:%=$O/fine/%) $(warps_obj:%=$O/draft/%)
$(warps_obj_both): HOST += -I$O
$(warps_obj_both): $O/bench_tables.h tests/bench/warps/warp_list.h

# The layers that warps need.
warps_src := $(sort $(foreach l,base math sample warp,$(wildcard \
    firmware/$l/*.c firmware/$l/*/*.c)))

$O/warps-pc: $(warps_obj:%=$O/fine/%) $(warps_src:%.c=$O/fine/%.o)
	$(link)

$O/warps-pc-draft: $(warps_obj:%=$O/draft/%) \
    $(warps_src:%.c=$O/draft/%.o)
	$(link)

bench: ## Instructions per ray, path and warp; ratios to float
bench: bench-boards bench-profile bench-warps bench-strategies bench-pc

PRECISIONS ?= draft fine

# $(call on_boards,BOARDS,NAME,OPTIONS): run a benchmark on each board, in each
# precision. NAME ends the names of the firmwares.
define on_boards
@for board in $(1); do for precision in $(PRECISIONS); do \
    $(MAKE) -s --no-print-directory bench-board BOARD=$$board \
        PRECISION=$$precision EMULATED=1 DIAG=1 DIRECT=area LIGHTS=power \
        VARIANT=-$(2)-$$precision $(3) || exit; \
done; done
endef
bench_main = BOARD_MAIN='$(addprefix tests/bench/,$(1) bench_board.c)'

bench-boards: $O/$(scene).qlb
	$(call on_boards,$(BOARDS),bench,$(call \
	    bench_main,bench_main.c rays/bench_rays.c))
	@for board in $(BOARDS); do \
	    $(MAKE) -s --no-print-directory bench-board BOARD=$$board \
	        EMULATED=1 DIAG=1 DIRECT=area LIGHTS=power \
	        VARIANT=-bench-float FLOAT=1 OPT=-O2 \
	        $(call bench_main,bench_main.c rays/bench_rays.c rays/float_pt.c) \
	        > $O/$$board/bench-float || exit; \
	    grep ' float ' $O/$$board/bench-float; \
	done

# WARP_BOARDS: where.
WARP_BOARDS ?= $(BOARDS)

bench-warps: ## Instructions per warp
bench-warps: bench-warps-boards bench-warps-pc

bench-warps-boards: $O/$(scene).qlb $O/bench_tables.h
	$(call on_boards,$(WARP_BOARDS),warps,$(call \
	    bench_main,warps/bench_warps.c warps/warp_list.c) STRATEGIES=1 LTO=0 \
	    FIRMWARE_SRC='$(warps_src)' \
	    CFLAGS_BOARD='-g0 -UQL_CFG_FEATURES_HEADER' FLAGS_MAIN=-I$O)

bench-warps-pc: $O/warps-pc $O/warps-pc-draft
	@tests/bench/warps/count_warps.sh $O/warps-pc-draft draft
	@tests/bench/warps/count_warps.sh $O/warps-pc fine

# STRATEGY_BOARDS, STRATEGY_BOUNCES: where, and how long paths are.
STRATEGY_BOARDS ?= lm3s6965evb microbit
STRATEGY_BOUNCES ?= 3

bench-strategies: ## Instructions per path under each direct strategy
bench-strategies: $O/$(scene).qlb
	$(call on_boards,$(STRATEGY_BOARDS),strategies,$(call \
	    bench_main,bench_strategies.c) STRATEGIES=1 CFLAGS_BOARD=-g0 \
	    FLAGS_MAIN='-DQL_BENCH_BOUNCES=$(STRATEGY_BOUNCES)')

ifneq ($(BOARD),)
bench-board: $(board_name).elf
	@tools/dev/limit.sh --cpu 120 $(BOARD_QEMU) -display none \
	    -monitor none -serial stdio -icount shift=0 \
	    -semihosting-config enable=on,target=native \
	    -kernel $< < /dev/null 2> $O/$(BOARD)/bench.log

bench-board-profile: $(board_lines)
	@tests/bench/profile.sh $< $(BOARD_CROSS) $(BOARD_CORE) $(BOARD_QEMU)
endif

bench-profile: ## Where the instructions of a path go, by source
bench-profile: $O/$(scene).qlb
	@for board in $(BOARDS); do for precision in $(PRECISIONS); do \
	    $(MAKE) -s --no-print-directory bench-board-profile BOARD=$$board \
	        PRECISION=$$precision EMULATED=1 DIAG=1 \
	        VARIANT=-profile-$$precision $(call bench_main,bench_profile.c) \
	        || exit; \
	done; done

# REPETITIONS: of how many a time is the median.
REPETITIONS ?= 31

bench-pc: $O/bench-pc $O/bench-pc-draft $O/$(scene).qlb $O/mesh.qlb
	@$O/bench-pc-draft --repetitions $(REPETITIONS) $O/$(scene).qlb \
	    $O/mesh.qlb
	@$O/bench-pc --repetitions $(REPETITIONS) $O/$(scene).qlb $O/mesh.qlb
	@tests/bench/rays/count_pc.sh $O/bench-pc-draft draft \
	    $O/$(scene).qlb $O/mesh.qlb

strategies: ## Noise and cost of each direct strategy, as a table and a picture
	@MAKE='$(MAKE)' tools/sheet/strategies.sh $(STRATEGY_OPTIONS)

choices: ## How good what `auto` stands for is, in every scene
choices: $O/qlux-scene $O/test/fine/tools/choose/choice_main
	@tests/tools/choose/choices.sh

shrink: ## Variance of each strategy as a light shrinks: build/shrink.svg
shrink: $O/qlux-scene $O/qlux-sim
	@tools/sheet/shrink.sh

# What events of a rendering take on each core (tools/lib/cost).

$O/cost-model: $O/host/tests/bench/cost/cost_main.o $(io) $(fine) $O/flags/link
	$(link)

cost-table: ## Count and fit tools/lib/cost/cost_table.h: half an hour
cost-table: $O/cost-model $O/qlux-scene
	@mkdir -p $O/cost && MAKE='$(MAKE)' \
	    tests/bench/cost/count_cost.sh > $O/cost/rows
	@$O/cost-model fit < $O/cost/rows > $O/cost/table.h && \
	    cp $O/cost/table.h tools/lib/cost/cost_table.h
	@$(MAKE) --no-print-directory $O/cost-model
	@$O/cost-model 0.17 < $O/cost/rows

budgets-update: ## Write what is measured into tests/budgets
	tests/bench/test_bench.sh --update $(BOARDS)

.PHONY: bench bench-boards bench-board bench-profile bench-board-profile \
    bench-pc bench-warps bench-warps-boards bench-warps-pc bench-strategies \
    budgets-update cost-table shrink strategies
