# fuzz.mk - a fuzzer of every format for each core, and what replays its inputs
# SPDX-License-Identifier: MIT
#
# The fuzzers are a build of their own, by clang, in $O/fuzz. The replay is a
# test under sanitizers: it shares the objects of those.

fuzz_src := $(filter-out %_main.c,$(wildcard tests/fuzz/*.c \
    tests/fuzz/formats/*.c))
fuzz_wrap := $(foreach f,exit malloc calloc realloc free fopen cli_read \
    cli_out_open cli_out_commit,-Wl,--wrap=$f)

# With the core $1.
define fuzz_program
$O/fuzz-$1: $(patsubst %.c,$O/$1/%.o,$(fuzz_src) tests/fuzz/fuzz_main.c \
    $(filter-out %_main.c,$(wildcard tools/scene/*.c tools/scene/*/*.c)) \
    tools/lib/render/open_blob.c $(core_src)) $(io) $O/flags/link
	$$(link) $(fuzz_wrap)
endef
$(foreach c,fine draft,$(eval $(call fuzz_program,$c)))

fuzz_san := $O/test/fine-san
$(fuzz_san)/fuzz/replay: $(patsubst %.c,$(fuzz_san)/%.o,$(fuzz_src) \
    tests/fuzz/replay_main.c) $(fuzz_san)/support.a $(fuzz_san)/core.a \
    $O/flags/link
	$(call step,LD,$@)mkdir -p $(@D) && $(CC) $(config_fine-san) $(LDFLAGS) \
	    $(fuzz_wrap) $(filter %.o %.a,$^) $(filter %/support.a,$^) -o $@ \
	    $(LDLIBS) -lm -lpthread

jobs_fuzz := fine-san/fuzz/replay|$(fuzz_san)/fuzz/replay;

T ?= 60
fuzz_flags = -O1 -g -fno-omit-frame-pointer $(sanitize)
fuzz: ## Random inputs to every reader, T=60 seconds a format
	@tools/dev/setup.sh
	@$(MAKE) --no-print-directory O=$O/fuzz CC=clang \
	    CFLAGS='$(fuzz_flags) -fsanitize=fuzzer-no-link' \
	    LDFLAGS='$(sanitize) -fsanitize=fuzzer' \
	    $O/fuzz/fuzz-fine $O/fuzz/fuzz-draft
	@tests/fuzz/run.sh $O/fuzz $(T)

.PHONY: fuzz
