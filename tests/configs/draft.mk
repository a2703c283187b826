# draft.mk - everything built in, draft precision
# SPDX-License-Identifier: MIT

config_draft := -DQL_CFG_PRECISION=0
