# boards.mk - the firmware of a board: build it, run it in its emulator, size it
# SPDX-License-Identifier: MIT
#
# A board's board.mk says
#
#   BOARD_CROSS  prefix of the compiler's name
#   BOARD_CPU    its options for the CPU; BOARD_FPU those for float
#   BOARD_CORE   name of the CPU in the rows of make bench
#   BOARD_OPT    optimisation, else -O2
#   BOARD_LTO    1 for optimisation of the whole program
#   BOARD_GATES  gates of the core that the board sets, as -DNAME=0
#   BOARD_MCU    linker/<this>.ld has the memory
#   BOARD_SRC    sources beside board.c and those of every board
#   BOARD_STACK  bytes
#   BOARD_SIZE   the picture unless make is told another: pixels,
#   BOARD_SPP    and samples a pixel
#   BOARD_PANEL  format of the panel, if there is one
#   BOARD_QEMU   the emulator
#   BOARD_FLASH  the program that loads a real board, with $elf, $hex, $bin
#   BOARD_DRAG   how to load it without one, as a person would be told
#
# tools/dev/variables.txt has the variables that choose picture and firmware.
# What the choice does not need is not built in: board_gates has the gates.
#
# A source is compiled only for choices that it reads. A board's firmwares share
# the core's objects, in a folder for each command of the compiler, gates in it;
# those of hal/ are in another, for QL_PORT_EMULATED. main() alone knows the
# picture: it is the firmware's own.

ifneq ($(BOARD),)
OPT ?= $(if $(filter 1,$(SMALL)),-Os,$(or $(BOARD_OPT),-O2))
BOARD_MAIN ?= hal/ql_main.c

# What the firmware is called, after the scene.
board_tags := $(if $(filter 1,$(SMALL)),small)
board_tags += $(if $(filter 0,$(board_indirect)),direct)
board_rows := $(strip $(BOARD) $(scene) $(board_tags) $(filter-out \
    auto,$(DIRECT)))
board_called = $O/$(BOARD)/$(scene)$(subst $(space),,$(addprefix \
    -,$(board_tags) $1))$(VARIANT)
board_name := $(call board_called,$(if $(filter 1,$(EMULATED)),emulated))
# How many instructions the emulator has counted.
board_count := $(call board_called,emulated).count

# The core is one file, its layers in their order.
board_src := $(or $(FIRMWARE_SRC),firmware/qlux.c $(sort $(wildcard \
    firmware/app/*.c))) $(sort $(filter-out hal/ql_main.c,$(wildcard \
    hal/*.c))) $(BOARD_MAIN) hal/ql_blob_data.S $(BOARD_SRC) \
    hal/boards/$(BOARD)/board.c

# A benchmark is a firmware too.
ifneq ($(filter bench-board%,$(MAKECMDGOALS)),)
include tests/bench/bench_board.mk
endif

# Whole-program optimisation; passes of it that make code longer are off, two of
# them only where they do so.
ifeq ($(LTO),1)
board_lto := -flto -flto-partition=one -fno-move-loop-invariants \
    -fno-tree-dominator-opts -fno-tree-loop-im $(if $(filter \
    1,$(SMALL)),,-fno-tree-ter -fno-reorder-blocks)
endif

board_cc := $(strip $(BOARD_CROSS)gcc $(BOARD_CPU) $(OPT) $(board_lto) \
    -std=c99 -pedantic -ffreestanding $(WARN) -Werror -ffunction-sections \
    -fdata-sections -fno-common -g -fno-asynchronous-unwind-tables \
    -fcallgraph-info=su -Ifirmware -Ihal -Ihal/boards/$(BOARD) -I. \
    -DQL_CFG_FEATURES_HEADER='"$(BLOB).h"' $(board_gates) \
    $(BOARD_GATES) $(CFLAGS_BOARD))
board_cc_hal := $(board_cc) $(board_port)
board_cc_main := $(board_cc_hal) $(board_main) $(board_bench) $(FLAGS_MAIN)
board_gap := 0
board_ld = $(BOARD_CROSS)gcc $(BOARD_CPU) $(if $(board_lto),$(OPT) \
    $(board_lto) -ffreestanding -g -fcallgraph-info=su) -nostdlib \
    -Wl,--gc-sections -Llinker -Wl,-T,$(BOARD_MCU).ld \
    -Wl,--defsym=ql_ld_stack_bytes=$(BOARD_STACK) \
    -Wl,--defsym=ql_ld_gap_bytes=$(board_gap) \
    -Wl,-Map,$(board_name).map -Wl,--no-warn-rwx-segments

# Functions that the linker throws away keep lines of debug information, from
# address 0. What reads those lines gets a firmware whose code begins above
# them; optimisation of the whole program leaves no such functions.
board_lines := $(board_name)$(if $(board_lto),,-lines).elf

# A folder of shared objects is named by a checksum of the command. Should two
# commands have the same, the file of flags makes objects anew.
board_sums := $(shell for command in $(call quote,$(board_cc)) $(call \
    quote,$(board_cc_hal)); do printf %s "$$command" | cksum; done)
board_core := $(BOARD)/core/$(word 1,$(board_sums))
board_hal := $(BOARD)/core/$(word 3,$(board_sums))-hal
board_own := $(board_name:$O/%=%)
board_obj := $(foreach s,$(board_src),$O/$(if $(filter \
    $(BOARD_MAIN) %.S,$s),$(board_own),$(if $(filter \
    hal/%,$s),$(board_hal),$(board_core)))/$s.o)

# Calls that only the compiler makes are not seen in time for optimisation of
# the whole program, so what they call is compiled apart.
board_apart := $O/$(board_hal)/hal/ql_mem.c.o
board_graphs := $(if $(board_lto),$(board_apart:.o=.ci) \
    $(board_name).elf.ltrans0.ltrans.ci,$(patsubst %.o,%.ci,$(filter \
    %.c.o,$(board_obj))))

# $(call board_objects,FOLDER,COMMAND): rules for $O/FOLDER/SOURCE.c.o.
board_flags = $O/flags/$(subst /,-,$1)
define board_objects
$(call flags,$(subst /,-,$1),$2)
$O/$1/%.c.o: %.c $(call board_flags,$1) $(BLOB).h
	$$(call step,CC,$$<)mkdir -p $$(@D) && $2 $$(if $$(filter \
	    $$@,$(board_apart)),-fno-lto) -MMD -MP -c $$< -o $$@
endef
$(eval $(call board_objects,$(board_core),$(board_cc)))
$(eval $(call board_objects,$(board_hal),$(board_cc_hal)))
$(eval $(call board_objects,$(board_own),$(board_cc_main)))
$(call flags,$(subst /,-,$(board_own)).elf,$(board_ld) $(board_obj))

firmware: $(board_name).hex $(board_name).bin $O/qlux-cost ## Build firmware
	$(if $(silent),,@$(board_report))

# What it takes, and how long, if make run has counted the instructions.
board_report = tools/dev/firmware_report.sh $(board_name) $(BOARD) \
    $(BOARD_CROSS)size $(board_count) $(if $(ERROR),,$O/qlux-cost \
    $(BLOB).qlb $(cost_options) --precision $(PRECISION))

$(board_name)/%.S.o: %.S $(call board_flags,$(board_own)) $(BLOB).qlb
	$(call step,AS,$<)mkdir -p $(@D) && $(BOARD_CROSS)gcc $(BOARD_CPU) -c $< \
	    -o $@ -DQL_BLOB_FILE='"$(BLOB).qlb"'

$(board_name).elf: $(board_obj) $(call board_flags,$(board_own)).elf \
    linker/sections.ld linker/$(BOARD_MCU).ld
	$(call step,LD,$@)$(board_ld) $(board_obj) -lgcc -o $@

$(board_name)-lines.elf: board_gap := 16384
$(board_name)-lines.elf: $(board_name).elf
	@$(subst $(board_name).map,$@.map,$(board_ld)) $(board_obj) -lgcc -o $@

$(board_name).hex: $(board_name).elf
	$(call step,HEX,$@)$(BOARD_CROSS)objcopy -O ihex $< $@

$(board_name).bin: $(board_name).elf
	$(call step,BIN,$@)$(BOARD_CROSS)objcopy -O binary $< $@

flash: firmware ## Load SCENE onto a real BOARD
	$(call step,FLASH,$(BOARD))elf=$(board_name).elf \
	    bin=$(board_name).bin hex=$(board_name).hex; \
	    tools/dev/flash.sh "$(BOARD_DRAG)" $(BOARD_FLASH)

board_picture := $O/$(scene)-$(BOARD)

run-emulated: $(board_name).elf $O/qlux-recv
	$(call step,RUN,$(board_picture).ppm)tools/dev/run_board.sh $(or \
	    $(if $(QUIET),--quiet),$(quiet)) --count $(board_count) \
	    $< $(board_picture).ppm $(BOARD_QEMU)
	$(if $(silent),,@echo $(board_picture).ppm)

# What the simulator makes of the same choice; to compare with the board's.
$(board_picture)-sim.ppm: $(BLOB).qlb $(simulator) FORCE
	$(call step,RENDER,$@)$(sim) --quiet

size-board: $(board_name).elf $(board_lines)
	@$(BOARD_CROSS)size -A $< | awk -v name='$(board_rows)' \
	    '/^\.(text|rodata|data) / { flash += $$2 } \
	    /^\.(data|bss) / { ram += $$2 } \
	    END { print name " flash: " flash; print name " ram: " ram }'
	@stack=$$(tools/dev/stack_report.sh $< $(BOARD_CROSS)objdump \
	    $(board_graphs)) && echo "$(board_rows) stack: $$stack"
	@tools/dev/size_report.sh $(board_lines) $(BOARD_CROSS) | \
	    sed 's/^/$(board_rows) flash-/'

test-stack: $(board_name).elf $O/qlux-recv
	@tests/boards/test_stack.sh $< $$(tools/dev/stack_report.sh $< \
	    $(BOARD_CROSS)objdump $(board_graphs)) $(BOARD_CROSS)nm $(BOARD_QEMU)

include $(wildcard $(board_obj:.o=.d))
else
firmware flash run-emulated size-board test-stack:
	@echo "$@: name a board: BOARD= one of $(boards)" >&2; exit 1
endif

run-board: ## Render SCENE on an emulated BOARD
run-board: $(if $(BOARD),$(board_name).hex $(board_name).bin)
	@$(MAKE) --no-print-directory run-emulated EMULATED=1
	$(if $(silent),,@$(board_report))

size: ## Flash, RAM and stack of SCENE on BOARD, or on every board
	@for board in $(or $(BOARD),$(BOARDS)); do \
	    $(MAKE) -s --no-print-directory size-board BOARD=$$board || exit; \
	done

test-template: # A port that does nothing must compile
	$(call step,CC,hal/template)$(CC) -std=c99 -pedantic -ffreestanding $(WARN) \
	    -Werror -Ifirmware -Ihal -Ihal/template -fsyntax-only \
	    hal/template/board.c hal/ql_*.c

test-boards: $(programs) ## Every board's picture is the simulator's
	@tests/boards/test_boards.sh $(BOARDS)

.PHONY: firmware flash run-board run-emulated size size-board test-boards \
    test-stack test-template
