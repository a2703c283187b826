# tests.mk - build every test, write the list of jobs, run them side by side
# SPDX-License-Identifier: MIT
#
# A configuration (tests/configs) is the core with one set of gates; unit tests
# run against each of them, everything else against the two precisions, fine and
# draft. Sanitizers are configurations of their own.

include $(wildcard tests/configs/*.mk)
configs := $(patsubst config_%,%,$(sort $(filter config_%,$(.VARIABLES))))
sanitize := -fsanitize=address,undefined -fno-sanitize-recover=all
config_fine-san := $(config_fine) $(sanitize)
config_draft-san := $(config_draft) -fsanitize=undefined \
    -fno-sanitize-recover=all

# The many others are compiled for unit tests only, and in less time. They try
# fewer random inputs; what they draw is compared bit for bit.
full := fine draft fine-san draft-san
test_flags = -Werror $(if $(filter fine draft,$1),-O2 -g1,-O1 \
    $(if $(filter %-san,$1),-g1 -DQL_TEST_SHARE=8,-g0 -DQL_TEST_SHARE=16))
test_lib := $(wildcard tests/support/*.c tests/support/picture/*.c) \
    $(wildcard sim/sim_hal.c sim/sim_fault.c firmware/app/*.c)
support := $(test_lib) $(filter-out %_main.c,$(sim_src)) \
    tests/known/double/double_pt.c tests/known/closed/rooms.c \
    tests/bench/rays/bench_rays.c \
    tests/bench/rays/float_pt.c $(lib_src) \
    $(filter-out %_main.c,$(wildcard tools/scene/*.c tools/scene/*/*.c)) \
    $(wildcard tools/figure/*.c) tools/trade/scene/trade_curve.c
# It renders every feature, so it needs a core that has every one.
reference := $(filter-out %_main.c,$(wildcard tools/ref/*.c)) \
    tests/known/double/rounding.c
support_unit := $(test_lib) tools/lib/program/cli.c \
    tools/lib/math/build_table.c
support_of = $(if $(filter $(full),$(1)),$(support) $(reference), \
    $(support_unit))

# What the product has is not compiled twice: the core, and what tools share.
core_of = $(if $(filter fine draft,$1),$O/$1,$O/test/$1)
support_from = $(if $(filter fine/tools/lib/% fine/tools/scene/%,$1/$2), \
    $O/host,$O/test/$1)

# Under configuration $1: the core, what tests share, and every test.
define rules_of
$(call objects,test/$1,$(call test_flags,$1) -Isim -Itests/known -Itests/bench \
    $(config_$1))

$O/test/$1/core.a: $(core_src:%.c=$(call core_of,$1)/%.o) $O/flags/sources
	$$(archive)

$O/test/$1/support.a: $(foreach s,$(call support_of,$1), \
    $(strip $(call support_from,$1,$s))/$(s:.c=.o)) $O/flags/sources
	$$(archive)

$O/test/$1/%: $O/test/$1/tests/%.o $O/test/$1/support.a $O/test/$1/core.a \
    $O/flags/link
	$$(call step,LD,$$@)mkdir -p $$(@D) && $$(CC) $(config_$1) \
	    $(call test_flags,$1) $$(LDFLAGS) $$(filter %.o %.a,$$^) \
	    $$(filter %/support.a,$$^) -o $$@ $$(LDLIBS) -lm -lpthread

# The same test, the same objects, with a seed from the environment.
$O/test/$1/seeds/%: $O/test/$1/tests/%.o $O/test/$1/tests/seeds/other_seeds.o \
    $O/test/$1/support.a $O/test/$1/core.a $O/flags/link
	$$(call step,LD,$$@)mkdir -p $$(@D) && $$(CC) $(config_$1) \
	    $(call test_flags,$1) $$(LDFLAGS) -Wl,--wrap=main \
	    -Wl,--wrap=ql_sampler_begin $$(filter %.o %.a,$$^) \
	    $$(filter %/support.a,$$^) -o $$@ $$(LDLIBS) -lm -lpthread
endef
all_configs := $(configs) fine-san draft-san
$(foreach c,$(all_configs),$(eval $(call rules_of,$c)))

# Of the configurations that the goals need, the headers that objects include.
built := $(if $(filter test-all test-configs,$(MAKECMDGOALS)),$(all_configs),\
    $(if $(filter test-%,$(MAKECMDGOALS)),$(full)))
built += $(foreach c,$(filter-out $(built),$(all_configs)),$(if $(findstring \
    $O/test/$c/,$(MAKECMDGOALS)),$c))
include $(foreach c,$(sort $(built)),$(call headers_of,test/$c))
.SECONDARY:

unit := $(patsubst tests/%.c,%,$(wildcard tests/unit/test_*.c))
tool := $(patsubst tests/%.c,%,$(wildcard tests/tools/test_*.c \
    tests/tools/*/test_*.c))
extreme := $(patsubst tests/%.c,%,$(wildcard tests/extreme/extreme_*.c))
known := $(patsubst tests/%.c,%,$(wildcard tests/known/known_*.c \
    tests/known/double/known_*.c tests/known/closed/known_*.c) \
    $(wildcard tests/stat/stat_*.c))

# Jobs, longest first, so that the last one is short: "name|command".
in = $(foreach t,$(2),$(1)/$(t)|$O/test/$(1)/$(t)$(if $(findstring \
    test_app,$(t)), $O/cornell.qlb);)
jobs_known := $(foreach c,fine draft,$(call in,$(c),$(known)))
jobs_quick := $(call in,fine,$(unit) $(tool) $(extreme)) \
    $(call in,draft,$(unit) $(extreme))
jobs_san := $(call in,fine-san,$(unit) $(tool) $(extreme)) \
    $(call in,draft-san,$(unit) $(extreme)) $(jobs_fuzz)
# Of programs that come out the same, byte for byte, one runs: known once built.
programs_configs := $(foreach c,$(filter-out $(full),$(configs)),$(addprefix \
    $O/test/$(c)/,$(unit)))
# What each of them draws has the bits of a build that has everything.
others := $(filter-out $(full),$(configs))
programs_golden := $(others:%=$O/test/%/golden/golden)
golden_blobs := $O/golden/blobs
$(golden_blobs): tests/golden/scenes.sh $O/qlux-scene $(wildcard tests/scenes/*)
	$(call step,SCENES,$(@D))tests/golden/scenes.sh $O/qlux-scene $(@D) && \
	    touch $@
jobs_gates := golden/gates|tests/golden/some.sh $(others); \
    configs/triples-1|tests/configs/test_gates.sh --triples 1/2; \
    configs/triples-2|tests/configs/test_gates.sh --triples 2/2; \
    configs/tables|tests/configs/test_tables.sh; \
    configs/gates|tests/configs/test_gates.sh;
jobs_configs = $(jobs_gates) $(shell tests/configs/jobs.sh $(programs_configs))
jobs_scripts := tools/make|tests/tools/test_make.sh; \
    tools/sim|tests/tools/test_sim.sh; \
    tools/options|tests/tools/lib/test_options.sh; \
    tools/open_blob|tests/tools/lib/test_open_blob.sh; \
    tools/files|tests/tools/lib/test_files.sh; \
    tools/kind|tests/tools/lib/test_kind.sh; \
    tools/diff|tests/tools/test_diff.sh; \
    tools/scene|tests/tools/scene/test_scene.sh; \
    tools/lines|tests/tools/scene/test_lines.sh; \
    tools/info|tests/tools/scene/test_info.sh; \
    tools/sky|tests/tools/scene/test_sky.sh; \
    tools/choice|tests/tools/choose/test_choice.sh; \
    tools/script|tests/tools/script/test_script.sh; \
    tools/bare|tests/tools/script/test_bare.sh; \
    tools/sight|tests/tools/script/test_sight.sh; \
    tools/faces|tests/tools/faces/test_faces.sh; \
    tools/readers|tests/tools/foreign/test_readers.sh; \
    tools/lut|tests/tools/test_lut.sh; \
    tools/warp|tests/tools/test_warp.sh; \
    tools/trade_scene|tests/tools/trade/test_trade_scene.sh; \
    tools/sheet|tests/tools/test_sheet.sh; \
    tools/ref|tests/tools/test_ref.sh; \
    tools/recv|tests/tools/test_recv.sh; \
    tools/merge|tests/tools/sums/test_merge.sh; \
    tools/terminal|tests/tools/terminal/test_terminal.sh; \
    tools/run|tests/tools/dev/test_run.sh; \
    tools/setup|tests/tools/dev/test_setup.sh;
jobs_farm := tools/parallel|tests/tools/farm/test_parallel.sh; \
    tools/slurm|tests/tools/farm/test_slurm.sh;
jobs_lint := lint/layers|tests/lint/check_layers.sh; \
    lint/circles|tests/lint/check_circles.sh; \
    lint/shape|tests/lint/check_shape.sh; \
    lint/docs|tests/lint/check_docs.sh; \
    lint/format|tests/lint/check_format.sh; \
    lint/lint|tests/tools/dev/test_lint.sh;
# A board's measurements use what its pictures compiled, so they come after.
then_lm3s6965evb := && tests/tools/test_tutorial.sh
jobs_boards := $(foreach b,$(boards),boards/$b|tests/boards/test_boards.sh $b \
    || failed=1 && tests/bench/test_bench.sh $b $(then_$b) && \
    [ -z "$$failed" ];) \
    tools/trade|tests/tools/test_trade.sh; \
    tools/trade_cost|tests/bench/cost/test_cost.sh; \
    bench/pc|tests/bench/test_bench.sh pc; \
    boards/template|tests/boards/test_boards.sh template; \
    boards/stack|tests/tools/test_stack_report.sh;
jobs_mutants := $(foreach k,1 2 3 4,mutants/$k-of-4|tests/mutants/run.sh \
    --share $k-of-4;)
# What users build, fine and draft by this machine's compiler, has the goldens
# too.
whole := $(foreach c,fine draft,$O/test/$(c)/golden/golden)
jobs_matrix = $(shell tests/matrix/run_matrix.sh --jobs) \
    extreme/programs|tests/extreme/extreme_programs.sh; \
    library/library|tests/library/test_library.sh; \
    golden/whole|tests/golden/some.sh fine draft;

# What scripts run beside the programs.
helpers := $(patsubst tests/%.c,$O/test/fine/%,$(wildcard \
    tests/tools/*_main.c tests/tools/*/*_main.c)) $O/cost-model

programs_of = $(filter $O/test/%,$(subst |, ,$(subst ;, ,$(1))))

# $(1) a list of jobs: build what they run, then run them.
define run
	@mkdir -p $O/test
	@printf '%s' '$(1)' | tr ';' '\n' | sed 's/^ *//; /^$$/d' > $O/test/jobs
	@tests/run.sh $O/test/jobs
endef

test: ## Run everything, on this PC and on every emulated board
	@tools/dev/setup.sh
	@$(MAKE) --no-print-directory -j$$(getconf _NPROCESSORS_ONLN) test-all; \
	    status=$$?; mkdir -p $O/test && times > $O/test/make.times; \
	    exit $$status

# What the boards' jobs share is made before them.
scenes_boards := glossy sky lens smooth square strategies
boards-ready: $(programs) $O/bench_tables.h
	@for scene in $(scenes_boards); do $(MAKE) --no-print-directory \
	    $O/$$scene.qlb SCENE=$$scene || exit; done
	@$(MAKE) --no-print-directory TABLE_BITS=5 TABLE_LERP=0 \
	    $O/qlux-sim-draft-nearest-5

test-all: boards-ready $(programs) $(helpers) $O/cornell.qlb \
    $O/mesh.qlb \
    $(call programs_of,$(jobs_known) $(jobs_quick) $(jobs_san)) \
    $(programs_configs) $(programs_golden) $(whole) $(golden_blobs)
	$(call run,$(jobs_boards)$(jobs_matrix)$(jobs_mutants)$(jobs_known)$(strip \
	    )$(jobs_san)$(jobs_configs)$(jobs_farm)$(jobs_quick)$(strip \
	    )$(jobs_scripts)$(jobs_lint))

quick := $(call programs_of,$(jobs_quick)) $(helpers)

test-quick: ## Unit and tool tests on this PC
test-quick: $(programs) $O/cornell.qlb $(quick)
	$(call run,$(jobs_quick)$(jobs_scripts))

answers := $(call programs_of,$(jobs_known))

test-known: ## Pictures whose answer is known
test-known: $O/cornell.qlb $O/mesh.qlb $(answers)
	$(call run,$(jobs_known))

test-san: ## Unit and tool tests under ASan and UBSan
test-san: $(call programs_of,$(jobs_san)) $O/cornell.qlb
	$(call run,$(jobs_san))

budget := $(foreach c,draft fine,$O/test/$(c)/known/double/known_budget)

error-budget: ## Error of every stage against double, as DESIGN.md has it
error-budget: $O/cornell.qlb $O/mesh.qlb $(budget)
	@for program in $(budget); do $$program --table || exit; echo; done

test-configs: ## Unit tests with every pair of gates, the core with every triple
test-configs: $(programs_configs) $(programs_golden) $(golden_blobs)
	$(call run,$(jobs_configs))

# N seeds; ONLY is a part of the names of the programs, as test_bsdf.
N ?= 4
seeds := $(foreach c,fine draft,$(foreach t,$(unit) $(known),$(if $(findstring \
    $(or $(ONLY),/),$(c)/$(t)),$O/test/$(c)/seeds/$(t))))

test-seeds: ## Unit and known tests with N other seeds; ONLY=name for a few
test-seeds: $(seeds) $O/cornell.qlb $O/mesh.qlb
	@tests/seeds/run.sh $(N) $(seeds)

test-mutants: ## Plant faults, one by one: a test has to see each
	@$(MAKE) --no-print-directory -j$$(getconf _NPROCESSORS_ONLN) \
	    $$(tests/mutants/run.sh --needs)
	@CC="$(CC)" tests/mutants/run.sh

lint: ## Layers, documents, format
	$(call run,$(jobs_lint))

check: lint test ## What must pass before a commit

format: ## Format every C file
	tests/lint/check_format.sh --write

configs-update: ## Rewrite the configurations of tests/configs/gates.txt
	tests/configs/test_gates.sh --write

docs: ## Bring the generated file lists up to date
	tests/lint/check_docs.sh --write

golden-update: ## Rewrite the checksums of the golden pictures
	tests/matrix/run_matrix.sh --update

.PHONY: test test-all boards-ready test-quick test-known test-san test-configs \
    test-mutants test-seeds error-budget lint check format configs-update docs \
    golden-update
