config_cornell := -DQL_CFG_PRECISION=0 -DQL_CFG_NODE8=0 -DQL_CFG_PAGES=0 \
    -DQL_CFG_TWO_SIDED=0 -DQL_CFG_SPHERES=0 -DQL_CFG_SMOOTH=0 \
    -DQL_CFG_PHONG=0 -DQL_CFG_MIRROR=0 -DQL_CFG_GLASS=0 -DQL_CFG_SKY=0 \
    -DQL_CFG_SKY_MAP=0 -DQL_CFG_TABLES=0 -DQL_CFG_LENS=0 \
    -DQL_CFG_STRATEGIES=0 -DQL_CFG_ADAPTIVE=0 -DQL_CFG_SAMPLERS=2 \
    -DQL_CFG_FORMATS=17
# Theirs take scenes of both widths of nodes and of every feature, and panels
# of every format.
unit_cornell = $(filter-out $(addprefix unit/test_,adaptive api app blob \
    bvh),$(unit))
