config_draft := -DQL_CFG_PRECISION=0
