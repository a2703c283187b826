# Makefile - every command; `make help` lists them
# SPDX-License-Identifier: MIT
#
#   make                        simulator, tools, the picture build/cornell.ppm
#   make run SCENE=s            any scene on this PC: build/s.ppm
#   make run BOARD=b SCENE=s    the same on an emulated board: build/s-b.ppm
#   make test                   everything
#
# SCENE is a name in tests/scenes or the path of a .scene or .obj. SPP=, SIZE=
# and the like choose the picture; V=1 prints the commands; O=DIR builds in DIR.
# The product needs a C99 compiler and GNU make 4.0; tools/dev/setup.sh installs
# what the tests need.

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SUFFIXES:
MAKEFLAGS += --no-builtin-rules

override O := $(or $(strip $O),build)
CC ?= cc
AR ?= ar
CFLAGS ?= -O2 -g
# Scripts find the programs by BUILD, and compile with the same warnings.
export BUILD := $O
export WARN := -Wall -Wextra -Wconversion -Wshadow -Wundef -Wmissing-prototypes
HOST = -std=c99 -pedantic $(WARN) $(CPPFLAGS) $(CFLAGS) \
    -D_POSIX_C_SOURCE=200809L -Ifirmware -Itools -Ihal -Itests -I.

include tools/dev/rules.mk tools/dev/variables.mk

core_src := $(sort $(filter-out firmware/app/%,$(wildcard firmware/*/*.c \
    firmware/*/*/*.c)))
fine := $(core_src:%.c=$O/fine/%.o)
draft := $(core_src:%.c=$O/draft/%.o)
io := $O/host/lib.a

names := scene lut merge cost diff sheet recv warp ref trade
programs := $(names:%=$O/qlux-%) $O/qlux-sim $O/qlux-sim-draft

all: ## Build everything for this PC, render the Cornell box
all: $(programs) $O/$(scene).ppm
	$(if $(silent),,@echo $O/$(scene).ppm)

tools: $(programs) ## Build the simulator and the tools

help: ## Show this list
	@awk 'BEGIN { FS = ":.*## " } /^[a-z0-9-]+:.*## / \
	    { printf "  %-16s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)
	@tools/dev/help.sh

# The core, once for each precision, and everything else of this PC.

$(call objects,fine,-DQL_CFG_PRECISION=1)
$(call objects,draft,-DQL_CFG_PRECISION=0)
$(call objects,host)
-include $(foreach f,fine draft host,$(call headers_of,$f))

lib_src := $(sort $(wildcard tools/lib/*/*.c))
$O/host/lib.a: $(lib_src:%.c=$O/host/%.o) $O/flags/sources
	$(archive)

# A program is its folder; some have others beside it, or a file that is apart.
beside_warp := figure
beside_trade := figure
apart_trade := tools/trade/trade_error.c
source_of = $(sort $(filter-out $(apart_$1),$(foreach d,$1 $(beside_$1), \
    $(wildcard tools/$d/*.c tools/$d/*/*.c))))

define program
$O/qlux-$1: $(patsubst %.c,$O/host/%.o,$(source_of_$1)) $(io) $(fine) \
    $O/flags/link $O/flags/sources
	$$(link)
endef
$(foreach n,$(names),$(eval source_of_$n := $(call source_of,$n)))
$(foreach n,$(names),$(eval $(call program,$n)))

# The boards that qlux-trade knows are those of hal/boards.
$O/boards.h: tools/trade/boards.awk $(sort $(wildcard hal/boards/*/board.h)) \
    $(sort $(wildcard hal/boards/*/board.mk))
	$(call step,BOARDS,$@)awk -f $^ > $@.tmp && mv $@.tmp $@
$O/host/tools/trade/scene/trade_boards.o: HOST += -DTRADE_BOARDS='"$O/boards.h"'
$O/host/tools/trade/scene/trade_boards.o: $O/boards.h

# Other tables of the warps than the tools have: build/qlux-sim-draft-nearest-9.
tables := $(if $(filter 7-1,$(TABLE_BITS)-$(TABLE_LERP)),,-$(if $(filter \
    0,$(TABLE_LERP)),nearest,lerp)-$(TABLE_BITS))
ifneq ($(tables),)
table_flags := -DQL_CFG_TABLE_BITS=$(TABLE_BITS) \
    -DQL_CFG_TABLE_LERP=$(TABLE_LERP)
$(call objects,fine$(tables),-DQL_CFG_PRECISION=1 $(table_flags))
$(call objects,draft$(tables),-DQL_CFG_PRECISION=0 $(table_flags))
-include $(foreach f,fine draft,$(call headers_of,$f$(tables)))
endif

sim_src := $(sort $(filter-out sim/sim_hal.c sim/sim_fault.c, \
    $(wildcard sim/*.c)))
# What of the tools opens scenes has the gates of the core that it is linked to.
sim_of = $(patsubst %.c,$O/$1/%.o,$(sim_src) tools/lib/render/open_blob.c \
    $(core_src)) $(io) $O/flags/link $O/flags/sources

$O/qlux-sim$(tables): $(call sim_of,fine$(tables))
	$(link)

$O/qlux-sim-draft$(tables): $(call sim_of,draft$(tables))
	$(link)

$(call flags,link,$(CC) $(CFLAGS) $(LDFLAGS) $(LDLIBS))
# A source that comes or goes links everything again.
$(call flags,sources,$(core_src) $(lib_src) $(sim_src) \
    $(foreach n,$(names),$(source_of_$n)))

# Scenes and pictures. Whoever makes make has BLOB has made it.

ifeq ($(BLOB),)
BLOB := $O/$(scene)
$(call flags,$(scene).qlb,$(call quote,$(scene_file)) $(SCENE_OPTIONS))
# A pattern of one file makes both at once: % is the dot.
$O/$(scene)%qlb $O/$(scene)%h: $O/qlux-scene $O/flags/$(scene).qlb \
    $(scene_newer)
	$(call step,SCENE,$O/$(scene).qlb)$< $(call quote,$(scene_file)) \
	    -o $O/$(scene).qlb --features $O/$(scene).h $(SCENE_OPTIONS) \
	    $(if $(verbose),,--quiet)
endif

simulator := $O/qlux-sim$(if $(filter draft,$(PRECISION)),-draft)$(tables)
sim = $(simulator) $(BLOB).qlb -o $@ $(sim_options) $(SIM_OPTIONS) $(quiet)
$(call flags,$(scene).ppm,$(simulator) $(sim_options) $(SIM_OPTIONS))

$O/$(scene).ppm: $(simulator) $(BLOB).qlb $O/flags/$(scene).ppm \
    $(if $(filter run run-pc,$(MAKECMDGOALS)),FORCE)
	$(call step,RENDER,$@)$(sim)

run: ## Render SCENE here, or on an emulated BOARD
run: $(if $(BOARD),run-board,run-pc)

run-pc: $O/$(scene).ppm
	$(if $(silent),,@echo $<)

luts: $O/qlux-lut ## Regenerate the core's tables
	$(call step,LUT,firmware/math/lut/ql_lut_data.c)$< \
	    -o firmware/math/lut/ql_lut_data.c

warp-plots: $O/qlux-warp ## Draw the warps of tools/README.md: build/warp-*.svg
	@for m in 1 2 8 16; do $< plot cosine-power -m $$m \
	    -o $O/warp-cosine-power-$$m.svg || exit; done
	@$< plot naive-hemisphere -o $O/warp-naive-hemisphere.svg

tutorial: $(programs) ## Do what sim/FIRST_ROOM.md says: build/tutorial
	@tools/dev/tutorial.sh sim/FIRST_ROOM.md $O/tutorial

clean: ## Remove build/
	rm -rf $O

include hal/boards.mk tools/trade/trade.mk
include tests/fuzz/fuzz.mk tests/tests.mk tests/bench/bench.mk

.PHONY: all tools help run run-pc luts warp-plots tutorial clean
