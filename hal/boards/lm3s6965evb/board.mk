# board.mk - LM3S6965 evaluation kit: Cortex-M3, 256 KB flash, 64 KB RAM, OLED
# SPDX-License-Identifier: MIT
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m3 -mthumb
BOARD_CORE := cortex-m3
BOARD_MCU := lm3s6965
BOARD_SRC := hal/cpu/ql_cortexm.c hal/drivers/ssd0323.c
BOARD_STACK := 3072
BOARD_SIZE := 128x64
BOARD_PANEL := gray4
BOARD_SPP := 8
BOARD_QEMU := qemu-system-arm -M lm3s6965evb
BOARD_FLASH := openocd -f board/ek-lm3s6965.cfg \
    -c "program $$elf verify reset exit"
