# fine.mk - everything built in, fine precision
# SPDX-License-Identifier: MIT

config_fine := -DQL_CFG_PRECISION=1
