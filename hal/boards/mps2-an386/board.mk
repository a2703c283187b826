# board.mk - Arm MPS2 with AN386: Cortex-M4F, 4 MB of each memory
# SPDX-License-Identifier: MIT
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
BOARD_CORE := cortex-m4f
BOARD_FPU := -mfloat-abi=hard -mfpu=fpv4-sp-d16
BOARD_MCU := mps2
BOARD_SRC := hal/cpu/ql_cortexm.c
BOARD_STACK := 3072
BOARD_SIZE := 64x64
BOARD_SPP := 16
BOARD_QEMU := qemu-system-arm -M mps2-an386
BOARD_DRAG := copy $$bin to its USB drive as its README.md says
