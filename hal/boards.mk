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
#   BOARD_MCU    linker/<this>.ld has the memory
#   BOARD_SRC    sources beside board.c and those of every board
#   BOARD_STACK  bytes
#   BOARD_SIZE   the picture unless make is told another: pixels,
#   BOARD_SPP    and samples a pixel
#   BOARD_PANEL  format of the panel, if there is one
#   BOARD_QEMU   the emulator
#   BOARD_FLASH  how to load a real board: $elf, $hex, $bin
#
# tools/dev/variables.txt has the variables that choose picture and firmware.
# What the choice does not need is not built in: board_defines has the gates.

ifneq ($(BOARD),)
OPT ?= $(if $(filter 1,$(SMALL)),-Os,$(or $(BOARD_OPT),-O2))
BOARD_MAIN ?= hal/ql_main.c

# What the firmware is called, after the scene.
board_tags := $(if $(filter 1,$(SMALL)),small)
board_tags += $(if $(filter 0,$(board_indirect)),direct)
board_rows := $(strip $(BOARD) $(scene) $(board_tags))
board_tags += $(if $(filter 1,$(EMULATED)),emulated)
board_name := $O/$(BOARD)/$(scene)$(subst $(space),,$(addprefix \
    -,$(board_tags)))$(VARIANT)

# Layers in their order: link-time optimisation inlines by the order of files,
# so the Cornell box takes 200 bytes less on a Cortex-M0 than by order of names.
layers := base math sample warp scene blob trace material light film render \
    app
board_src := $(or $(FIRMWARE_SRC),$(foreach layer,$(layers),$(sort $(wildcard \
    firmware/$(layer)/*.c firmware/$(layer)/*/*.c)))) \
    $(sort $(filter-out hal/ql_main.c,$(wildcard hal/*.c))) $(BOARD_MAIN) \
    hal/ql_blob_data.S $(BOARD_SRC) hal/boards/$(BOARD)/board.c
board_obj := $(patsubst %,$(board_name)/%.o,$(board_src))

# Whole-program optimisation; three passes of it that make code longer are off.
# Calls that only the compiler makes are not seen in time, so what they call is
# compiled apart.
board_apart := $(board_name)/hal/ql_mem.c.o
ifeq ($(LTO),1)
board_lto := -flto -flto-partition=one -fno-move-loop-invariants \
    -fno-tree-dominator-opts -fno-tree-loop-im
board_graphs := $(board_apart:.o=.ci) $(board_name).elf.ltrans0.ltrans.ci
else
board_graphs := $(patsubst %.o,%.ci,$(filter %.c.o,$(board_obj)))
endif

# A benchmark is a firmware too.
ifneq ($(filter bench-board,$(MAKECMDGOALS)),)
include tests/bench/bench_board.mk
endif

board_cc := $(BOARD_CROSS)gcc $(BOARD_CPU) $(OPT) $(board_lto) -std=c99 \
    -pedantic -ffreestanding $(WARN) -Werror -ffunction-sections \
    -fdata-sections -fno-common -g -fno-asynchronous-unwind-tables \
    -fcallgraph-info=su -Ifirmware -Ihal -Ihal/boards/$(BOARD) -I. \
    -DQL_CFG_FEATURES_HEADER='"$(BLOB).h"' $(board_defines) $(board_bench) \
    $(CFLAGS_BOARD)
board_ld := $(BOARD_CROSS)gcc $(BOARD_CPU) $(if $(board_lto),$(OPT) \
    $(board_lto) -ffreestanding -g -fcallgraph-info=su) -nostdlib \
    -Wl,--gc-sections -Llinker -Wl,-T,$(BOARD_MCU).ld \
    -Wl,--defsym=ql_ld_stack_bytes=$(BOARD_STACK) \
    -Wl,-Map,$(board_name).map -Wl,--no-warn-rwx-segments

board_flags := $(subst /,-,$(board_name:$O/%=%))
$(call flags,$(board_flags),$(board_cc) $(board_ld) $(board_obj))

firmware: $(board_name).hex $(board_name).bin ## Build BOARD's firmware
	$(if $(silent),,@echo $<)

$(board_name)/%.c.o: %.c $O/flags/$(board_flags) $(BLOB).h
	$(call step,CC,$<)mkdir -p $(@D) && $(board_cc) $(if $(filter \
	    $@,$(board_apart)),-fno-lto) -MMD -MP -c $< -o $@

$(board_name)/%.S.o: %.S $O/flags/$(board_flags) $(BLOB).qlb
	$(call step,AS,$<)mkdir -p $(@D) && $(BOARD_CROSS)gcc $(BOARD_CPU) -c $< \
	    -o $@ -DQL_BLOB_FILE='"$(BLOB).qlb"'

$(board_name).elf: $(board_obj) linker/sections.ld linker/$(BOARD_MCU).ld
	$(call step,LD,$@)$(board_ld) $(board_obj) -lgcc -o $@

$(board_name).hex: $(board_name).elf
	$(call step,HEX,$@)$(BOARD_CROSS)objcopy -O ihex $< $@

$(board_name).bin: $(board_name).elf
	$(call step,BIN,$@)$(BOARD_CROSS)objcopy -O binary $< $@

flash: firmware ## Load SCENE onto a real BOARD
	$(call step,FLASH,$(BOARD))elf=$(board_name).elf \
	    bin=$(board_name).bin hex=$(board_name).hex; $(BOARD_FLASH)

board_picture := $O/$(scene)-$(BOARD)

run-emulated: $(board_name).elf $O/qlux-recv
	$(call step,RUN,$(board_picture).ppm)tools/dev/run_board.sh $(or \
	    $(if $(QUIET),--quiet),$(quiet)) $< $(board_picture).ppm $(BOARD_QEMU)
	$(if $(silent),,@echo $(board_picture).ppm)

# What the simulator makes of the same choice; to compare with the board's.
$(board_picture)-sim.ppm: $(BLOB).qlb $(simulator) FORCE
	$(call step,RENDER,$@)$(sim) --quiet

size-board: $(board_name).elf
	@$(BOARD_CROSS)size -A $< | awk -v name='$(board_rows)' \
	    '/^\.(text|rodata|data) / { flash += $$2 } \
	    /^\.(data|bss) / { ram += $$2 } \
	    END { print name " flash: " flash; print name " ram: " ram }'
	@stack=$$(tools/dev/stack_report.sh $< $(BOARD_CROSS)objdump \
	    $(board_graphs)) && echo "$(board_rows) stack: $$stack"
	@tools/dev/size_report.sh $< $(BOARD_CROSS) | \
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
	@$(MAKE) --no-print-directory run-emulated EMULATED=1

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
