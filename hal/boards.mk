# boards.mk - the firmware of a board: build it, run it in its emulator, size it
#
# SIZE, SPP, SEED, BOUNCES, SAMPLER, DIRECT, INDIRECT, LIGHTS, LIGHT_SAMPLES,
# ROULETTE (0 or 1), INTERLACE choose the picture, in the simulator's words;
# PRECISION is draft or fine; TABLE_BITS and TABLE_LERP are those of the gates. STRATEGIES=1 builds every estimator in, which is
# the default only if one is asked for. ERROR=E stops a pixel at a relative error
# of E; only then is the code for it built in. What the choice does not need is
# not built in: the other sampler, with INDIRECT=none or BOUNCES=0 all that
# follows the first hit, without a panel its code and formats. SMALL=1 asks for
# short code before fast code: the gate QL_CFG_SMALL, link-time optimisation
# (LTO=0 does without) and, unless DIAG=1, no counters. SCENE is a name: the main
# Makefile makes build/SCENE.qlb and build/SCENE.h of it; BLOB names others.

BOARDS := $(notdir $(patsubst %/,%,$(wildcard hal/boards/*/)))
PRECISION ?= draft

ifneq ($(BOARD),)
ifeq ($(filter $(BOARD),$(BOARDS)),)
$(error BOARD=$(BOARD): use one of $(BOARDS))
endif
include hal/boards/$(BOARD)/board.mk
SMALL ?= 0
LTO ?= $(or $(BOARD_LTO),$(SMALL))
DIAG ?= $(if $(filter 1,$(SMALL)),0,1)
OPT ?= $(if $(filter 1,$(SMALL)),-Os,$(or $(BOARD_OPT),-O2))
SIZE ?= $(BOARD_SIZE)
SPP ?= $(BOARD_SPP)
SEED ?= 0
BOUNCES ?= 4
SAMPLER ?= sobol
DIRECT ?= area
INDIRECT ?= brdf
LIGHTS ?= power
LIGHT_SAMPLES ?= 1
ROULETTE ?= 0
INTERLACE ?= 1
board_choice := --size $(SIZE) --spp $(SPP) --seed $(SEED) \
    --bounces $(BOUNCES) --sampler $(SAMPLER) --direct $(DIRECT) \
    --indirect $(INDIRECT) --lights $(LIGHTS) \
    --light-samples $(LIGHT_SAMPLES) $(if $(filter 1,$(ROULETTE)),--roulette) \
    $(if $(ERROR),--error $(ERROR))
STRATEGIES ?= $(if $(filter-out none area,$(DIRECT))$(filter \
    uniform,$(INDIRECT))$(filter-out power,$(LIGHTS))$(filter-out \
    1,$(LIGHT_SAMPLES))$(filter 1,$(ROULETTE)),1,0)
# as the simulator rounds it
board_error = $(if $(ERROR),-DQL_APP_ERROR_Q16=$(shell awk \
    'BEGIN { printf "%d", $(ERROR) * 65536 + 0.5 }'))
INDIRECT_BUILT := $(if $(filter none,$(INDIRECT))$(filter \
    0,$(BOUNCES)),0,1)
# 1 << ql_format_t, of the panel, and of the stream
bit_rgb565-le := 2
bit_rgb565-be := 4
bit_gray8 := 8
bit_gray4 := 16
board_formats := (1$(BOARD_PANEL:%=+$(bit_$(BOARD_PANEL))))
# mis -> QL_PREFIX_MIS, solid-angle -> QL_PREFIX_SOLID_ANGLE
board_word = QL_$(1)_$(shell echo $(2) | tr a-z- A-Z_)

# EMULATED=1 leaves the emulator when done; a real board would hang on that.
EMULATED ?= 0
BOARD_MAIN ?= hal/ql_main.c
board_name := build/$(BOARD)/$(SCENE)$(if $(filter 1,$(SMALL)),-small)$(if \
    $(filter 0,$(INDIRECT_BUILT)),-direct)$(if \
    $(filter 1,$(EMULATED)),-emulated)$(VARIANT)
board_rows := $(BOARD) $(SCENE)$(if $(filter 1,$(SMALL)), small)$(if \
    $(filter 0,$(INDIRECT_BUILT)), direct)
board_src := $(or $(FIRMWARE_SRC),$(wildcard firmware/*/*.c)) \
    $(filter-out hal/ql_main.c,$(wildcard hal/*.c)) $(BOARD_MAIN) \
    hal/ql_blob_data.S $(BOARD_SRC) hal/boards/$(BOARD)/board.c
board_obj := $(addprefix $(board_name)/,$(addsuffix .o,$(board_src)))
# Whole-program optimisation; three passes of it that make code longer are off.
# Calls that only the compiler makes are not seen in time, so what they call is
# compiled apart.
board_lto := $(if $(filter 1,$(LTO)),-flto -flto-partition=one \
    -fno-move-loop-invariants -fno-tree-dominator-opts -fno-tree-loop-im)
board_apart := $(board_name)/hal/ql_mem.c.o
board_ci := $(patsubst %.o,%.ci,$(if $(board_lto),$(board_apart) \
    $(board_name).elf.ltrans0.ltrans.o,$(filter %.c.o,$(board_obj))))

board_cflags := $(BOARD_CPU) $(OPT) $(board_lto) -std=c99 -pedantic -ffreestanding \
    $(WARN) -Werror -ffunction-sections -fdata-sections -fno-common -g \
    -fno-asynchronous-unwind-tables -fcallgraph-info=su \
    -Ifirmware -Ihal -Ihal/boards/$(BOARD) -I. \
    -DQL_CFG_FEATURES_HEADER='"$(BLOB).h"' \
    -DQL_CFG_PRECISION=$(if $(filter fine,$(PRECISION)),1,0) \
    -DQL_CFG_TABLE_BITS=$(TABLE_BITS) -DQL_CFG_TABLE_LERP=$(TABLE_LERP) \
    -DQL_PORT_EMULATED=$(EMULATED) \
    -DQL_APP_WIDTH=$(word 1,$(subst x, ,$(SIZE))) \
    -DQL_APP_HEIGHT=$(word 2,$(subst x, ,$(SIZE))) \
    -DQL_APP_SPP=$(SPP) -DQL_APP_SEED=$(SEED)u -DQL_APP_BOUNCES=$(BOUNCES) \
    -DQL_APP_SAMPLER=QL_SAMPLER_$(if $(filter random,$(SAMPLER)),RANDOM,SOBOL) \
    -DQL_APP_DIRECT=$(call board_word,DIRECT,$(DIRECT)) \
    -DQL_APP_INDIRECT=$(call board_word,INDIRECT,$(INDIRECT)) \
    -DQL_APP_LIGHTS=$(call board_word,LIGHTS,$(LIGHTS)) \
    -DQL_APP_LIGHT_SAMPLES=$(LIGHT_SAMPLES) -DQL_APP_ROULETTE=$(ROULETTE) \
    -DQL_APP_INTERLACE=$(INTERLACE) -DQL_CFG_STRATEGIES=$(STRATEGIES) \
    -DQL_CFG_ADAPTIVE=$(if $(ERROR),1,0) $(board_error) \
    -DQL_CFG_INDIRECT=$(INDIRECT_BUILT) -DQL_CFG_SMALL=$(SMALL) \
    -DQL_CFG_SAMPLERS=$(if $(filter random,$(SAMPLER)),1,2) \
    -DQL_CFG_PANEL=$(if $(BOARD_PANEL),1,0) \
    -DQL_CFG_FORMATS='$(board_formats)' -DQL_CFG_DIAG=$(DIAG) \
    $(CFLAGS_BOARD)

firmware: $(board_name).hex $(board_name).bin ## Build BOARD's firmware

# A change of any choice builds again: the flags are a file others depend on.
$(board_name)/flags: FORCE
	@mkdir -p $(@D)
	@printf '%s\n' '$(subst ','\'',$(board_cflags))' | cmp -s - $@ || \
	    printf '%s\n' '$(subst ','\'',$(board_cflags))' > $@

$(board_name)/%.c.o: %.c $(board_name)/flags $(BLOB).h
	@mkdir -p $(@D)
	$(BOARD_CROSS)gcc $(board_cflags) $(if $(filter \
	    $@,$(board_apart)),-fno-lto) -MMD -MP -c $< -o $@

$(board_name)/%.S.o: %.S $(board_name)/flags $(BLOB).qlb
	@mkdir -p $(@D)
	$(BOARD_CROSS)gcc $(BOARD_CPU) -c $< -o $@ \
	    -DQL_BLOB_FILE='"$(BLOB).qlb"'

$(board_name).elf: $(board_obj) linker/sections.ld linker/$(BOARD_MCU).ld
	$(BOARD_CROSS)gcc $(BOARD_CPU) $(if $(board_lto),$(OPT) $(board_lto) \
	    -ffreestanding -g -fcallgraph-info=su) -nostdlib -Wl,--gc-sections -Llinker \
	    -Wl,-T,$(BOARD_MCU).ld -Wl,--defsym=ql_ld_stack_bytes=$(BOARD_STACK) \
	    -Wl,-Map,$(board_name).map -Wl,--no-warn-rwx-segments \
	    $(board_obj) -lgcc -o $@

$(board_name).hex $(board_name).bin: $(board_name).elf
	$(BOARD_CROSS)objcopy -O $(if $(filter %.hex,$@),ihex,binary) $< $@

flash: firmware ## Load SCENE onto a real BOARD
	elf=$(board_name).elf bin=$(board_name).bin hex=$(board_name).hex; \
	    $(BOARD_FLASH)

run-emulated: $(board_name).elf build/qlux-recv
	tools/dev/run_board.sh $(if $(QUIET),--quiet) $< build/$(SCENE)-$(BOARD).ppm \
	    $(BOARD_QEMU)

# What the simulator makes of the same choice; to compare with the board's.
board_sim := build/qlux-sim$(if $(filter draft,$(PRECISION)),-draft)$(tables)
build/$(SCENE)-$(BOARD)-sim.ppm: $(BLOB).qlb $(board_sim) FORCE
	$(board_sim) $< -o $@ --quiet $(board_choice)

size-board: $(board_name).elf
	@$(BOARD_CROSS)size -A $< | awk -v name='$(board_rows)' \
	    '/^\.(text|rodata|data) / { flash += $$2 } \
	    /^\.(data|bss) / { ram += $$2 } \
	    END { print name " flash: " flash; print name " ram: " ram }'
	@stack=$$(tools/dev/stack_report.sh $< $(BOARD_CROSS)objdump \
	    $(board_ci)) && echo "$(board_rows) stack: $$stack"
	@tools/dev/size_report.sh $< $(BOARD_CROSS) | sed 's/^/$(board_rows) flash-/'

test-stack: $(board_name).elf build/qlux-recv
	tests/boards/test_stack.sh $< $$(tools/dev/stack_report.sh $< \
	    $(BOARD_CROSS)objdump $(board_ci)) $(BOARD_CROSS)nm $(BOARD_QEMU)

-include $(board_obj:.o=.d)
else
firmware flash:
	@echo "$@: needs BOARD=, one of $(BOARDS)" >&2; exit 1
endif

.PHONY: firmware flash run-board run-emulated size size-board test-boards \
    test-stack test-template FORCE
run-board: ## Render SCENE on an emulated BOARD
	@$(MAKE) --no-print-directory run-emulated EMULATED=1

size: ## Flash, RAM and stack of SCENE on BOARD, or on every board
	@for board in $(or $(BOARD),$(BOARDS)); do \
	    $(MAKE) -s --no-print-directory size-board BOARD=$$board || exit; \
	done

test-template: # A port that does nothing must compile
	$(CC) -std=c99 -pedantic -ffreestanding $(WARN) -Werror -Ifirmware -Ihal \
	    -Ihal/template -fsyntax-only hal/template/board.c hal/ql_*.c

test-boards: $(programs) ## Every board's picture is the simulator's
	tests/boards/test_boards.sh $(BOARDS)
