# trade.mk - what every choice costs and how exact it is

build/qlux-trade: $(patsubst %.c,build/host/%.o,$(wildcard tools/figure/*.c) \
    $(addprefix tools/trade/,trade_main.c trade_plot.c trade_table.c)) $(io) $(fine)
	$(link)

trade: ## Error against instructions of every choice: build/trade.csv, .svg
	@MAKE='$(MAKE)' tools/trade.sh

trade-quick: ## The same of a few choices, on one core, in a minute
	@MAKE='$(MAKE)' tools/trade.sh --quick

# tools/trade.sh writes the rules of the measurements and comes back for them.
ifneq ($(TRADE_RULES),)
CORE := $(core_src) $(core_hdr)
include $(TRADE_RULES)
trade-measure: $(TRADE_TARGETS)
endif

.PHONY: trade trade-quick trade-measure
