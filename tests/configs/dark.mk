# dark.mk - no emitters, no paths beyond the first hit
# SPDX-License-Identifier: MIT

config_dark := -DQL_CFG_PRECISION=0 -DQL_CFG_NODE16=0 -DQL_CFG_LIGHTS=0 \
    -DQL_CFG_SKY=0 -DQL_CFG_SKY_MAP=0 -DQL_CFG_INDIRECT=0 -DQL_CFG_SAMPLERS=1
