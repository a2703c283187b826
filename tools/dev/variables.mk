# variables.mk - what make was given, checked; what follows from it
# SPDX-License-Identifier: MIT
#
# After it every variable of tools/dev/variables.txt has its value, and
#   scene          name of the picture's files: that of SCENE, _ for blanks
#   scene_file     the path of the .scene or .obj; quote it for the shell
#   scene_newer    FORCE if the scene, or what lies beside it, is newer
#   sim_options    the picture in the words of qlux-sim
#   board_gates    for the compiler of BOARD: what every source reads,
#   board_port     hal/ too,
#   board_main     and main() alone
#   board_indirect 1 if BOARD's firmware has paths beyond the first hit

ifneq ($(or $(findstring $(space),$O),$(findstring ',$O)),)
$(error O=$O: use the path of a folder without blanks)
endif
ifneq ($(wildcard $O/Makefile $O/.git),)
$(error O=$O: use a folder that make clean may remove)
endif

boards := $(sort $(notdir $(patsubst %/,%,$(wildcard hal/boards/*/))))
BOARDS ?= $(boards)
ifneq ($(filter $(BOARD),$(boards)),)
include hal/boards/$(BOARD)/board.mk
endif

given := $(foreach v,$(.VARIABLES),$(if $(filter command,$(firstword \
    $(origin $v))),$(if $(filter MAKE%  -*%,$v),,$v)))
known = $(foreach v,$(given),$(call quote,given $v=$($v))) \
    $(foreach v,SIZE SPP LTO PANEL,'board $v=$(BOARD_$v)') \
    'board PRECISION=draft' 'boards $(boards)' \
    'scenes $(sort $(basename $(notdir $(wildcard tests/scenes/*.scene))))' \
    $(call quote,goals $(MAKECMDGOALS)) 'level $(MAKELEVEL)'
chosen := $(shell printf '%s\n' $(known) | awk -f tools/dev/gates.awk \
    -f tools/dev/choose.awk tools/dev/variables.txt -)
ifeq ($(firstword $(chosen)),error)
$(error $(wordlist 2,$(words $(chosen)),$(chosen)))
endif
$(foreach word,$(chosen),$(eval override $(word)))

# Words of make have no blanks: the path is never one, but quoted for the shell.
override SCENE := $(or $(SCENE),cornell)
scene_file := $(SCENE)
ifeq ($(filter %.scene %.obj,$(subst $(space),_,$(SCENE))),)
scene_file := tests/scenes/$(SCENE).scene
endif
scene_newer := $(if $(shell f=$(call quote,$(scene_file)); d=$${f%/*}; \
    [ "$$d" != "$$f" ] || d=.; find "$$f" "$$d"/*.obj "$$d"/*.mtl "$$d"/*.pfm \
    "$$d"/*.txt -newer $O/$(scene).qlb 2> /dev/null),FORCE)
