# trade.mk - what every choice costs and how exact it is
# SPDX-License-Identifier: MIT
#
# The head of trade.sh draws who calls whom.

trade: ## Error against instructions of every choice: build/trade.csv, .svg
	@MAKE='$(MAKE)' tools/trade/trade.sh

trade-quick: ## The same of a few choices, on one core, in a minute
	@MAKE='$(MAKE)' tools/trade/trade.sh --quick

ifneq ($(TRADE_RULES),)
# Beside these, what has the gates in its name.
trade_tables := $(foreach l,math sample warp,$(wildcard firmware/$l/*.c \
    firmware/$l/*/*.c)) firmware/blob/ql_blob_open.c firmware/render/ql_line.c
# What a firmware of bench_settings.c is made of.
CORE := $(core_src) $(wildcard firmware/app/*.c firmware/*.h firmware/*/*.h \
    firmware/*/*/*.h hal/*.h) tests/bench/bench_settings.c \
    $(wildcard tests/bench/bench_board.*)
trade_done = > $@.tmp 2> $@.log && mv $@.tmp $@ || \
    { tail -n 5 $@.log >&2; exit 1; }

trade_blob = @mkdir -p $(@D) && $O/qlux-scene $< -o $@ --quiet \
    --features $(@:.qlb=.h) $(ARGS) 2> $(@:.qlb=.log)
trade_reference = @mkdir -p $(@D) && $O/qlux-ref $< -o $@ $(ARGS) \
    --direct mis --bounces 24 --roulette --threads 1 --quiet
# The core's objects but for what the tables change, which is compiled here.
trade_core = @mkdir -p $(@D) && $(CC) $(HOST) $(ARGS) $(filter-out $(foreach \
    f,fine draft,$(trade_tables:%.c=$O/$f/%.o)),$(filter %.o %.c \
    %.a,$^)) -o $@ -lpthread -lm
trade_error = @$< $(wordlist 2,3,$^) $(ARGS) $(trade_done)
trade_cost = @$(MAKE) -s --no-print-directory bench-board EMULATED=1 $(ARGS) \
    TRADE_RULES= \
    BOARD_MAIN='tests/bench/bench_settings.c tests/bench/bench_board.c' \
    FLAGS_MAIN=-I$(@D) CFLAGS_BOARD='-g0 -UQL_CFG_ADAPTIVE -DQL_CFG_ADAPTIVE=1 \
    -UQL_CFG_SAMPLERS -DQL_CFG_SAMPLERS=3' $(trade_done)

include $(TRADE_RULES)
trade-measure: $(TRADE_TARGETS)
endif

.PHONY: trade trade-quick trade-measure
