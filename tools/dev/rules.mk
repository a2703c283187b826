# rules.mk - what every rule is written with: short output, flags, objects
# SPDX-License-Identifier: MIT

ifneq ($(filter 3.%,$(MAKE_VERSION)),)
$(error This is GNU make $(MAKE_VERSION); qlux needs GNU make 4.0 or newer)
endif

empty :=
space := $(empty) $(empty)
comma := ,
define tab
	
endef

# $(call quote,TEXT): one word for the shell.
quote = '$(subst ','\'',$1)'

# $(call step,CC,FILE)COMMAND: a recipe that prints "  CC  FILE". V=1 prints the
# command instead, make -s neither.
verbose := $(filter 1,$(V))
silent := $(findstring s,$(filter-out --%,$(firstword -$(MAKEFLAGS))))
quiet := $(if $(silent),--quiet)
step = $(if $(verbose)$(silent),,$(info $(empty)  $1$(tab)$2))$(hide)
hide := $(if $(verbose),,@)

# $(call flags,NAME,TEXT): the file $O/flags/NAME, which is as old as TEXT is.
# A rule that uses TEXT depends on it. One look at all of them as make starts
# finds those that differ, so make -n tells what would be built.
flags_kept := $(shell cat $O/flags/* 2> /dev/null)
define flags_rule
$O/flags/$1: $(if $(findstring <$1 $2 $1>,$(flags_kept)),,FORCE)
	@mkdir -p $$(@D)
	@printf '%s\n' $(subst $$,$$$$,$(call quote,<$1 $2 $1>)) > $$@
endef
flags = $(eval $(call flags_rule,$1,$(strip $2)))

# $(call objects,FAMILY,FLAGS): rules for $O/FAMILY/SOURCE.o of any SOURCE.c.
# Each object depends on the flags and on the headers that it includes.
define objects_rule
$O/$1/%.o: %.c $O/flags/$(subst /,-,$1)
	$$(call step,CC,$$<)mkdir -p $$(@D) && \
	    $$(CC) $$(HOST) $2 -MMD -MP -c $$< -o $$@
endef
objects = $(call flags,$(subst /,-,$1),$(CC) $(HOST) $2)$(eval \
    $(call objects_rule,$1,$2))

# $(call headers_of,FAMILY): what earlier compilations found out.
headers_of = $(wildcard $O/$1/*/*.d $O/$1/*/*/*.d $O/$1/*/*/*/*.d)

archive = $(call step,AR,$@)mkdir -p $(@D) && rm -f $@ && \
    $(AR) rcs $@ $(filter %.o,$^)
link = $(call step,LD,$@)mkdir -p $(@D) && $(CC) $(CFLAGS) $(LDFLAGS) \
    $(filter %.o,$^) $(filter %.a,$^) -o $@ $(LDLIBS) -lpthread -lm

FORCE:
.PHONY: FORCE
