# board.mk - BBC micro:bit: Cortex-M0, 256 KB flash, 16 KB RAM
# SPDX-License-Identifier: MIT
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m0 -mthumb
BOARD_CORE := cortex-m0
BOARD_OPT := -Os
BOARD_LTO := 1
BOARD_GATES := -DQL_CFG_SLANTED=0
BOARD_MCU := nrf51822
BOARD_SRC := hal/cpu/ql_cortexm.c
BOARD_STACK := 3072
BOARD_SIZE := 64x64
BOARD_SPP := 4
BOARD_QEMU := qemu-system-arm -M microbit
BOARD_DRAG := copy $$hex to the drive MICROBIT
BOARD_FLASH := pyocd flash -t nrf51 $$elf
