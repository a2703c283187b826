# bench_board.mk - what the firmware of a benchmark is compiled with
# SPDX-License-Identifier: MIT

board_bench := -Itests -DQL_BENCH_CORE='"$(BOARD_CORE)"'
ifneq ($(FLOAT),)
board_bench += -DQL_BENCH_FLOAT=1 -fno-math-errno
ifneq ($(BOARD_FPU),)
BOARD_CPU := $(filter-out -mfloat-abi=soft,$(BOARD_CPU)) $(BOARD_FPU)
endif
endif
