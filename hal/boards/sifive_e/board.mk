# board.mk - SiFive HiFive1: RV32IMAC, 16 MB flash read in place, 16 KB RAM
# SPDX-License-Identifier: MIT
BOARD_CROSS := riscv64-unknown-elf-
BOARD_CPU := -march=rv32imac -mabi=ilp32 -mcmodel=medany -msmall-data-limit=0
BOARD_CORE := rv32imac
BOARD_MCU := fe310
BOARD_SRC := hal/cpu/ql_riscv.c
BOARD_STACK := 3072
BOARD_SIZE := 64x64
BOARD_SPP := 4
BOARD_QEMU := qemu-system-riscv32 -M sifive_e -bios none
BOARD_FLASH := openocd -f board/sifive-hifive1.cfg \
    -c "program $$elf verify reset exit"
