# bench.mk - instructions per ray and path on every board, ratios on this PC

bench_obj := $(addprefix tests/bench/,bench_pc.o bench_rays.o float_pt.o)
$(bench_obj:%=build/fine/%) $(bench_obj:%=build/draft/%): \
    HOST += -fno-math-errno -Itests/bench

build/bench-pc: $(bench_obj:%=build/fine/%) $(fine)
	$(link)

build/bench-pc-draft: $(bench_obj:%=build/draft/%) $(draft)
	$(link)

build/make-mesh: build/host/tests/bench/make_mesh.o
	$(link)

build/mesh.qlb build/mesh.h &: build/make-mesh build/qlux-scene
	build/make-mesh build
	build/qlux-scene build/mesh.scene -o build/mesh.qlb \
	    --features build/mesh.h --quiet

bench: bench-boards bench-pc ## Instructions per ray and path; ratios to float

bench-boards: build/$(SCENE).qlb
	@for board in $(BOARDS); do for precision in draft fine; do \
	    $(MAKE) -s --no-print-directory bench-board BOARD=$$board \
	        PRECISION=$$precision EMULATED=1 VARIANT=-bench-$$precision \
	        BOARD_MAIN='tests/bench/bench_main.c tests/bench/bench_rays.c' \
	        || exit; \
	done; done
	@for board in $(BOARDS); do \
	    $(MAKE) -s --no-print-directory bench-board BOARD=$$board \
	        EMULATED=1 VARIANT=-bench-float FLOAT=1 OPT=-O2 BOARD_MAIN="$$(echo \
	        tests/bench/bench_main.c tests/bench/bench_rays.c \
	        tests/bench/float_pt.c)" > build/bench-float || exit; \
	    grep ' float ' build/bench-float; \
	done

ifneq ($(BOARD),)
ifneq ($(and $(FLOAT),$(BOARD_FPU)),)
BOARD_CPU := $(filter-out -mfloat-abi=soft,$(BOARD_CPU)) $(BOARD_FPU)
endif
bench-board: board_cflags += -Itests/bench \
    -DQL_BENCH_CORE='"$(BOARD_CORE)"' \
    $(if $(FLOAT),-DQL_BENCH_FLOAT=1 -fno-math-errno $(BOARD_FPU))
bench-board: $(board_name).elf
	@timeout 120 $(BOARD_QEMU) -display none -monitor none -serial stdio \
	    -icount shift=0 -semihosting-config enable=on,target=native \
	    -kernel $< < /dev/null 2> build/$(BOARD)/bench.log
endif

bench-pc: build/bench-pc build/bench-pc-draft build/$(SCENE).qlb build/mesh.qlb
	@build/bench-pc-draft build/$(SCENE).qlb build/mesh.qlb
	@build/bench-pc build/$(SCENE).qlb build/mesh.qlb
	@tests/bench/count_pc.sh build/bench-pc-draft draft \
	    build/$(SCENE).qlb build/mesh.qlb

.PHONY: bench bench-boards bench-board bench-pc
