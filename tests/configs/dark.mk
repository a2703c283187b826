config_dark := -DQL_CFG_PRECISION=0 -DQL_CFG_NODE16=0 -DQL_CFG_LIGHTS=0 \
    -DQL_CFG_SKY=0 -DQL_CFG_SKY_MAP=0 -DQL_CFG_INDIRECT=0 -DQL_CFG_SAMPLERS=1
# What needs no scene, as those of the tests have emitters, and no Sobol points.
unit_dark := $(addprefix unit/test_,alias cdf crc film fx gates hash lobe lut \
    real rgb sampler sky sobol spherical square table tonemap tri trig vec \
    warp)
