config_fine := -DQL_CFG_PRECISION=1
