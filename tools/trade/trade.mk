# trade.mk - what every choice costs and how exact it is

build/qlux-trade: $(patsubst %.c,build/host/%.o,$(wildcard tools/figure/*.c) \
    $(addprefix tools/trade/,trade_main.c trade_plot.c trade_table.c)) $(io) $(fine)
	$(link)

trade: ## Error against instructions of every choice: build/trade.csv, .svg
	@MAKE='$(MAKE)' tools/trade/trade.sh

trade-quick: ## The same of a few choices, on one core, in a minute
	@MAKE='$(MAKE)' tools/trade/trade.sh --quick

# tools/trade/trade.sh writes the rules of the measurements (rules.awk), with ARGS for
# each, and comes back for them.
ifneq ($(TRADE_RULES),)
CORE := $(core_src) $(wildcard firmware/app/*.c) $(core_hdr) tests/bench/bench_settings.c \
    $(wildcard tests/bench/bench_board.*)
trade_tables := $(wildcard firmware/math/*.c firmware/sample/*.c firmware/warp/*.c)
trade_done = > $@.tmp 2> $@.log && mv $@.tmp $@ || \
    { tail -n 5 $@.log >&2; exit 1; }

trade_blob = @mkdir -p $(@D) && build/qlux-scene $< -o $@ --quiet \
    --features $(@:.qlb=.h) $(ARGS) 2> $(@:.qlb=.log)
trade_reference = @mkdir -p $(@D) && build/qlux-ref $< -o $@ $(ARGS) \
    --direct mis --bounces 24 --roulette --threads 1 --quiet
trade_core = @mkdir -p $(@D) && $(CC) $(HOST) $(ARGS) $(filter-out $(patsubst \
    %.c,build/fine/%.o,$(trade_tables)) $(patsubst \
    %.c,build/draft/%.o,$(trade_tables)),$(filter %.o %.c %.a,$^)) -o $@ -lm
trade_error = @$< $(wordlist 2,3,$^) $(ARGS) $(trade_done)
trade_cost = @$(MAKE) -s --no-print-directory bench-board EMULATED=1 $(ARGS) TRADE_RULES= \
    BOARD_MAIN='tests/bench/bench_settings.c tests/bench/bench_board.c' \
    CFLAGS_BOARD='-I$(@D) -UQL_CFG_ADAPTIVE -DQL_CFG_ADAPTIVE=1 \
    -UQL_CFG_SAMPLERS -DQL_CFG_SAMPLERS=3' $(trade_done)

include $(TRADE_RULES)
trade-measure: $(TRADE_TARGETS)
endif

.PHONY: trade trade-quick trade-measure
