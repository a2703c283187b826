# bench.mk - instructions per ray, path and warp; ratios to float on this PC

bench_obj := $(addprefix tests/bench/rays/,bench_pc.o bench_rays.o float_pt.o)
$(bench_obj:%=build/fine/%) $(bench_obj:%=build/draft/%): \
    HOST += -fno-math-errno

build/bench-pc: $(bench_obj:%=build/fine/%) $(fine)
	$(link)

build/bench-pc-draft: $(bench_obj:%=build/draft/%) $(draft)
	$(link)

build/make-mesh: build/host/tests/bench/rays/make_mesh.o
	$(link)

build/mesh.qlb build/mesh.h &: build/make-mesh build/qlux-scene
	build/make-mesh build
	build/qlux-scene build/mesh.scene -o build/mesh.qlb \
	    --features build/mesh.h --quiet

# Warps: the same list of calls in a firmware and in a program.

build/make-tables: build/host/tests/bench/warps/make_tables.o $(io)
	$(link)

build/bench_tables.h: build/make-tables
	build/make-tables -o $@

warps_obj := $(addprefix tests/bench/warps/,warps_pc.o warp_list.o)
warps_obj_both := $(warps_obj:%=build/fine/%) $(warps_obj:%=build/draft/%)
$(warps_obj_both): HOST += -Ibuild
$(warps_obj_both): build/bench_tables.h tests/bench/warps/warp_list.h

# The layers that warps need.
warps_src := $(wildcard $(addprefix firmware/,base/*.c math/*.c sample/*.c warp/*.c))

build/warps-pc: $(warps_obj:%=build/fine/%) $(warps_src:%.c=build/fine/%.o)
	$(link)

build/warps-pc-draft: $(warps_obj:%=build/draft/%) \
    $(warps_src:%.c=build/draft/%.o)
	$(link)

bench: bench-boards bench-warps bench-strategies bench-pc ## Instructions per ray, path and warp; ratios to float

PRECISIONS ?= draft fine

# $(call on_boards,BOARDS,NAME,OPTIONS): run a benchmark on each board, in each
# precision. Each NAME has its own folder of object files.
define on_boards
@for board in $(1); do for precision in $(PRECISIONS); do \
    $(MAKE) -s --no-print-directory bench-board BOARD=$$board \
        PRECISION=$$precision EMULATED=1 VARIANT=-$(2)-$$precision $(3) \
        || exit; \
done; done
endef
bench_main = BOARD_MAIN='$(addprefix tests/bench/,$(1) bench_board.c)'

bench-boards: build/$(SCENE).qlb
	$(call on_boards,$(BOARDS),bench,$(call \
	    bench_main,bench_main.c rays/bench_rays.c))
	@for board in $(BOARDS); do \
	    $(MAKE) -s --no-print-directory bench-board BOARD=$$board \
	        EMULATED=1 VARIANT=-bench-float FLOAT=1 OPT=-O2 $(call bench_main,\
	        bench_main.c rays/bench_rays.c rays/float_pt.c) > build/bench-float || exit; \
	    grep ' float ' build/bench-float; \
	done

# WARP_BOARDS: where.
WARP_BOARDS ?= $(BOARDS)

bench-warps: build/$(SCENE).qlb build/bench_tables.h build/warps-pc \
    build/warps-pc-draft ## Instructions per warp
	$(call on_boards,$(WARP_BOARDS),warps,$(call \
	    bench_main,warps/bench_warps.c warps/warp_list.c) STRATEGIES=1 LTO=0 \
	    FIRMWARE_SRC='$(warps_src)' \
	    CFLAGS_BOARD='-UQL_CFG_FEATURES_HEADER -Ibuild')
	@tests/bench/warps/count_warps.sh build/warps-pc-draft draft
	@tests/bench/warps/count_warps.sh build/warps-pc fine

# STRATEGY_BOARDS, STRATEGY_BOUNCES: where, and how long paths are.
STRATEGY_BOARDS ?= lm3s6965evb microbit
STRATEGY_BOUNCES ?= 3

bench-strategies: build/$(SCENE).qlb ## Instructions per path under each direct strategy
	$(call on_boards,$(STRATEGY_BOARDS),strategies,$(call \
	    bench_main,bench_strategies.c) STRATEGIES=1 \
	    CFLAGS_BOARD='-DQL_BENCH_BOUNCES=$(STRATEGY_BOUNCES)')

ifneq ($(BOARD),)
ifneq ($(and $(FLOAT),$(BOARD_FPU)),)
BOARD_CPU := $(filter-out -mfloat-abi=soft,$(BOARD_CPU)) $(BOARD_FPU)
endif
bench-board: board_cflags += -Itests \
    -DQL_BENCH_CORE='"$(BOARD_CORE)"' \
    $(if $(FLOAT),-DQL_BENCH_FLOAT=1 -fno-math-errno $(BOARD_FPU))
bench-board: $(board_name).elf
	@timeout 120 $(BOARD_QEMU) -display none -monitor none -serial stdio \
	    -icount shift=0 -semihosting-config enable=on,target=native \
	    -kernel $< < /dev/null 2> build/$(BOARD)/bench.log
endif

bench-pc: build/bench-pc build/bench-pc-draft build/$(SCENE).qlb build/mesh.qlb
	@build/bench-pc-draft build/$(SCENE).qlb build/mesh.qlb
	@build/bench-pc build/$(SCENE).qlb build/mesh.qlb
	@tests/bench/rays/count_pc.sh build/bench-pc-draft draft \
	    build/$(SCENE).qlb build/mesh.qlb

strategies: ## Noise and cost of each direct strategy, as a table and a picture
	@MAKE='$(MAKE)' tools/sheet/strategies.sh $(STRATEGY_OPTIONS)

.PHONY: bench bench-boards bench-board bench-pc bench-warps bench-strategies \
    strategies
