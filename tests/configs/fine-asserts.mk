config_fine-asserts := -DQL_CFG_PRECISION=1 -DQL_CFG_ASSERT=1
