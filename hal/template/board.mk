# board.mk - what make needs to know of a board; copy it to begin a port
# SPDX-License-Identifier: MIT
# Prefix of the compiler's name, and its options for this CPU.
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m0 -mthumb
# linker/<this>.ld has the memory.
BOARD_MCU := template
# Sources beside board.c and those every board has.
BOARD_SRC := hal/cpu/ql_cortexm.c
# Bytes of stack; make size prints what is needed.
BOARD_STACK := 2048
# The picture unless make is told another: pixels, samples a pixel.
BOARD_SIZE := 64x64
BOARD_SPP := 4
# With a panel: BOARD_PANEL := its format (rgb565-be, gray4, ..), as in board.h.
# BOARD_LTO := 1 for link-time optimisation.
# The emulator, and how to load a real board ($elf, $hex, $bin): BOARD_FLASH is
# a program and its arguments, BOARD_DRAG says how it goes without one.
BOARD_QEMU := false
BOARD_FLASH := false
