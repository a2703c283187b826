config_tables-short := -DQL_CFG_PRECISION=1 -DQL_CFG_TABLE_BITS=5
