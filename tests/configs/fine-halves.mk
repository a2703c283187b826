config_fine-halves := -DQL_CFG_PRECISION=1 -DQL_PORT_WIDE_MUL=0
