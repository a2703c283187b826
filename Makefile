# Makefile - every command; `make help` lists them
#
#   make                        simulator, tools and the picture build/cornell.ppm
#   make run SCENE=s            any scene on this PC: build/s.ppm
#   make run BOARD=b SCENE=s    the same on an emulated board: build/s-b.ppm
#   make test                   everything
#
# SCENE is a name in tests/scenes or the path of any .scene file. The product
# needs a C99 compiler and make; tools/dev/setup.sh installs what the tests need.

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:

SCENE ?= cornell
scene_file := $(if $(filter %.scene,$(SCENE)),$(SCENE),tests/scenes/$(SCENE).scene)
override SCENE := $(basename $(notdir $(SCENE)))

CC ?= cc
CFLAGS ?= -O2 -g
WARN := -Wall -Wextra -Wconversion -Wshadow -Wundef -Wmissing-prototypes
HOST := -std=c99 -pedantic $(WARN) $(CFLAGS) -D_POSIX_C_SOURCE=200809L \
    -Ifirmware -Itools -Ihal -Itests -I.

core_src := $(filter-out firmware/app/%,$(wildcard firmware/*/*.c))
core_hdr := $(wildcard firmware/*.h firmware/*/*.h hal/*.h)
host_hdr := $(core_hdr) $(wildcard tools/*/*.h tools/*/*/*.h sim/*.h)
fine := $(core_src:%.c=build/fine/%.o)
draft := $(core_src:%.c=build/draft/%.o)
lib_src := $(wildcard tools/lib/*/*.c)
io := build/host/lib.a

programs := $(addprefix build/qlux-,scene lut sim sim-draft merge diff sheet recv warp \
    ref trade)

all: $(programs) build/$(SCENE).ppm ## Build everything for this PC, render the Cornell box

tools: $(programs) ## Build the simulator and the tools

help: ## Show this list
	@awk 'BEGIN { FS = ":.*## " } /^[a-z0-9-]+:.*## / \
	    { printf "  %-16s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

# The core, once for each precision, and everything else of this PC.

build/fine/%.o: %.c $(host_hdr)
	@mkdir -p $(@D)
	$(CC) $(HOST) -DQL_CFG_PRECISION=1 -c $< -o $@

build/draft/%.o: %.c $(host_hdr)
	@mkdir -p $(@D)
	$(CC) $(HOST) -DQL_CFG_PRECISION=0 -c $< -o $@

# Other tables of the warps than the tools have: build/qlux-sim-draft-nearest-9.
TABLE_BITS ?= 7
TABLE_LERP ?= 1
tables := $(if $(filter 7-1,$(TABLE_BITS)-$(TABLE_LERP)),,-$(if $(filter \
    0,$(TABLE_LERP)),nearest,lerp)-$(TABLE_BITS))
ifneq ($(tables),)
build/fine$(tables)/%.o build/draft$(tables)/%.o: %.c $(host_hdr)
	@mkdir -p $(@D)
	$(CC) $(HOST) -DQL_CFG_PRECISION=$(if $(findstring build/fine,$@),1,0) \
	    -DQL_CFG_TABLE_BITS=$(TABLE_BITS) -DQL_CFG_TABLE_LERP=$(TABLE_LERP) \
	    -c $< -o $@
endif

build/host/%.o: %.c $(host_hdr)
	@mkdir -p $(@D)
	$(CC) $(HOST) -c $< -o $@

build/host/lib.a: $(lib_src:%.c=build/host/%.o)
	rm -f $@ && ar rcs $@ $^

link = $(CC) $(CFLAGS) $(filter %.o,$^) $(filter %.a,$^) -o $@ -lm

build/qlux-lut: build/host/tools/lut/lut_main.o $(io) $(fine)
	$(link)

build/qlux-scene: $(patsubst %.c,build/host/%.o,$(wildcard \
    tools/scene/*.c tools/scene/*/*.c)) \
    $(io) $(fine)
	$(link)

build/qlux-merge: build/host/tools/merge/merge_main.o $(io) $(fine)
	$(link)

build/qlux-diff: $(patsubst %.c,build/host/%.o,$(wildcard tools/diff/*.c)) \
    $(io) $(fine)
	$(link)

build/qlux-sheet: build/host/tools/sheet/sheet_main.o $(io) $(fine)
	$(link)

build/qlux-recv: build/host/tools/recv/recv_main.o $(io) $(fine)
	$(link)

build/qlux-warp: $(patsubst %.c,build/host/%.o,$(wildcard tools/warp/*.c \
    tools/figure/*.c)) $(io) $(fine)
	$(link)

build/qlux-ref: $(patsubst %.c,build/host/%.o,$(wildcard tools/ref/*.c)) $(io) $(fine)
	$(link) -lpthread

sim := sim/sim_main.o sim/sim_render.o

build/qlux-sim$(tables): $(sim:%=build/fine$(tables)/%) $(io) \
    $(core_src:%.c=build/fine$(tables)/%.o)
	$(link) -lpthread

build/qlux-sim-draft$(tables): $(sim:%=build/draft$(tables)/%) $(io) \
    $(core_src:%.c=build/draft$(tables)/%.o)
	$(link) -lpthread

# Scenes and pictures.

BLOB ?= build/$(SCENE)

$(BLOB).qlb $(BLOB).h &: $(scene_file) build/qlux-scene \
    $(foreach e,obj mtl pfm txt,$(wildcard $(dir $(scene_file))*.$(e)))
	build/qlux-scene $< -o $(BLOB).qlb --features $(BLOB).h $(SCENE_OPTIONS)

build/$(SCENE).ppm: build/qlux-sim build/$(SCENE).qlb
	build/qlux-sim build/$(SCENE).qlb -o $@ --spp 64

run: $(if $(BOARD),run-board,run-pc) ## Render SCENE here, or on an emulated BOARD

run-pc: build/qlux-sim build/$(SCENE).qlb
	build/qlux-sim build/$(SCENE).qlb -o build/$(SCENE).ppm $(SIM_OPTIONS)

luts: build/qlux-lut ## Regenerate the core's tables
	build/qlux-lut -o firmware/math/ql_lut_data.c

warp-plots: build/qlux-warp ## Draw the warps of tools/README.md: build/warp-*.svg
	for m in 1 2 8 16; do build/qlux-warp plot cosine-power -m $$m \
	    -o build/warp-cosine-power-$$m.svg || exit; done
	build/qlux-warp plot naive-hemisphere -o build/warp-naive-hemisphere.svg

clean: ## Remove build/
	rm -rf build

include hal/boards.mk tools/trade/trade.mk
include tests/tests.mk tests/bench/bench.mk

.PHONY: all tools help run run-pc luts warp-plots clean
