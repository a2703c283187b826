config_draft-halves := -DQL_CFG_PRECISION=0 -DQL_PORT_WIDE_MUL=0
