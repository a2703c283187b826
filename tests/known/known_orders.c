/* known_orders.c - each order of mirror, glass and wall under every strategy */
/* SPDX-License-Identifier: MIT */

/* A path meets three plates, then light of one radiance that is all around: the
 * sky, or a room of lamps. Each plate is a wall, a mirror, clear glass (of
 * index 1, so that nothing is bent) or half wall, half mirror. The plates are
 * of sizes so different that each sees nothing but what is next in the order,
 * and light:
 *
 *             light
 *     ------------------- 2: 200 wide, 20 above 1
 *               - 1: 2 wide
 *
 *     =================== 3: 20000 wide, 3000 below 1
 *             light
 *
 * The camera looks at 1 from above, or through it from below if it is glass. So
 * the picture is a polynomial of reflectances and of the form factors of two
 * squares, less what the smaller plates hide of the larger: below a part in
 * 100. Which of its terms count depends on the bounces allowed and on one rule
 * alone: without direct light only what is seen over mirrors and through glass
 * from the camera on shows light. */

#include <math.h>

#include "support/picture/estimate.h"
#include "support/picture/lambert.h"
#include "support/ql_double.h"
#include "support/ql_test.h"
#include "qlux.h"

#define RADIANCE 0.5
#define LIMIT    0.13 /* of RADIANCE: 8 standard errors and more; see teeth */

enum { SAMPLES = 512, PLATES = 3, CENTRE = 16384 };

/* What a plate is made of, and how much of the light each lobe sends on. */
enum { WALL, MIRROR, GLASS, MIXED, KINDS };
static const struct kind {
    char name;
    double diffuse, specular;
} kinds[KINDS] = {
        {'w', 0.9, 0}, {'m', 0, 0.85}, {'g', 0, 0.95}, {'x', 0.4, 0.5}};

enum { ORDERS = KINDS * KINDS * KINDS };

/* Kinds of the plates 1, 2, 3 of an order. */
typedef struct {
    int plate[PLATES];
} order_t;

static order_t order_of(int i)
{
    const order_t order = {{i / (KINDS * KINDS), i / KINDS % KINDS, i % KINDS}};

    return order;
}

/* ---- What is expected ---------------------------------------------------- */

/* Form factor of a square with its middle at a height above a point. */
static double square_seen(double half, double height)
{
    const lambert_polygon_t square = {
            {{-half, -half, height}, {half, -half, height},
                    {half, half, height}, {-half, half, height}},
            4};
    static const double up[3] = {0, 0, 1};

    return fabs(lambert_form_factor(&square, up));
}

/* The rule, and wrong ones that the pictures have to tell from it. */
typedef enum {
    RIGHT,
    WALL_FORGOTTEN,  /* without direct light: a mirror always shows light */
    MIRROR_IS_WALL,  /* without direct light: a mirror never does */
    ONE_BOUNCE_MORE, /* than was asked for */
    LAST_SHOWS_NONE, /* the last vertex's mirror shows no light */
    RULES
} rule_t;

typedef struct {
    const order_t *order;
    bool direct; /* is there a strategy of direct light? */
    rule_t rule;
} model_t;

/* How a path came to a plate: along one line, or off a wall. */
typedef enum { BEAM, SPREAD } arrival_t;

/* Light that a lobe sees: of what it sees a part `on` is the next plate. */
static double seen(const model_t *m, int at, double on, arrival_t arrival,
        bool specular, bool shown, unsigned bounces);

/* Radiance of plate `at`. */
static double plate(const model_t *m, int at, arrival_t arrival, bool specular,
        unsigned bounces)
{
    const int kind = m->order->plate[at];
    const struct kind *k = kinds + kind;
    const double at_2 = square_seen(100, 20);
    const double from_2 = square_seen(10000, 3020);
    /* below a mirror whose every ray to plate 3 passes its inside */
    const double by_2 = arrival == BEAM ? 1 : square_seen(10000, 3040) / at_2;
    const double wall_on[PLATES] = {at_2, from_2, 0};
    const double line_on[PLATES] = {1, kind == GLASS ? 0 : by_2, 0};
    const bool last = bounces == 0 && m->rule == LAST_SHOWS_NONE;
    const bool shows =
            m->direct || (m->rule != MIRROR_IS_WALL &&
                                 (specular || m->rule == WALL_FORGOTTEN));

    return k->diffuse *
                   seen(m, at, wall_on[at], SPREAD, false, m->direct, bounces) +
           k->specular * seen(m, at, line_on[at], arrival, specular,
                                 shows && !last, bounces);
}

static double seen(const model_t *m, int at, double on, arrival_t arrival,
        bool specular, bool shown, unsigned bounces)
{
    return (shown ? (1 - on) * RADIANCE : 0) +
           (on > 0 && bounces > 0 ? on * plate(m, at + 1, arrival, specular,
                                                 bounces - 1)
                                  : 0);
}

static double expected(
        const order_t *order, bool direct, unsigned bounces, rule_t rule)
{
    const model_t m = {order, direct, rule};

    return plate(&m, 0, BEAM, true, bounces + (rule == ONE_BOUNCE_MORE));
}

/* ---- The scene ----------------------------------------------------------- */

typedef enum { SKY, LAMPS } light_t;

static mini_scene_t m;

/* A square about the centre, its front up or down. */
static void add_plate(int kind, int32_t half, int32_t height, bool up)
{
    const int32_t z = CENTRE + height, low = CENTRE - half;
    const int32_t high = CENTRE + half;
    const int32_t a[3] = {low, low, z}, b[3] = {high, low, z};
    const int32_t c[3] = {high, high, z}, d[3] = {low, high, z};
    const uint16_t material = mini_material(&m, kinds[kind].diffuse, 0);

    if (kind == GLASS) {
        mini_gloss(&m, material, QL_GLOSS_GLASS, kinds[kind].specular, 1);
    } else if (kind != WALL) {
        mini_gloss(&m, material, QL_GLOSS_MIRROR, kinds[kind].specular, 0);
    }
    if (up) {
        mini_quad(&m, a, b, c, d, material);
    } else {
        mini_quad(&m, d, c, b, a, material);
    }
}

static void build(const order_t *order, light_t light)
{
    static const int32_t low[3] = {8, 8, 8}, high[3] = {32759, 32759, 32759};
    const bool through = order->plate[0] == GLASS;

    mini_begin(&m);
    add_plate(order->plate[0], 1, 0, true);
    add_plate(order->plate[1], 100, 20, false);
    add_plate(order->plate[2], 10000, -3000, true);
    if (light == SKY) {
        mini_sky(&m, RADIANCE, RADIANCE, RADIANCE);
    } else {
        mini_room(&m, low, high, mini_material(&m, 0, RADIANCE));
    }
    mini_eye(&m, CENTRE - 3 + 0.25, CENTRE + 0.5,
            through ? CENTRE - 10 : CENTRE + 10);
    mini_look(&m, 0.15, 0, through ? 0.5 : -0.5);
}

/* ---- Claims -------------------------------------------------------------- */

static unsigned long cases;
static double worst;

static void check_case(
        const order_t *order, light_t light, const ql_settings_t *settings)
{
    static const char *const names[] = {
            "none", "area", "hemisphere", "cosine", "solid-angle", "mis"};
    const bool goes_on = settings->indirect != QL_INDIRECT_NONE;
    const double wanted = expected(order, settings->direct != QL_DIRECT_NONE,
            goes_on ? settings->bounces : 0, RIGHT);
    const double got = estimate_pixel(&m, settings, 0, 0, SAMPLES).mean;
    const double off = fabs(got - wanted) / RADIANCE;

    CHECK(wanted > 0 ? off <= LIMIT : got == 0,
            "%c%c%c under %s, direct %u (%s), indirect %u, %u bounces: %.4f, "
            "want %.4f",
            kinds[order->plate[0]].name, kinds[order->plate[1]].name,
            kinds[order->plate[2]].name, light == SKY ? "sky" : "lamps",
            settings->direct,
            settings->direct < 6 ? names[settings->direct] : "",
            settings->indirect, settings->bounces, got, wanted);
    worst = fmax(worst, off);
    cases++;
}

/* Every order under one strategy: each number of bounces with directions drawn
 * by BRDF, all bounces with those of another density or with none. */
static void check_strategy(unsigned direct)
{
    cases = 0;
    worst = 0;
    for (int i = 0; i < 2 * ORDERS; i++) {
        const order_t order = order_of(i / 2);
        const light_t light = i % 2 == 0 ? SKY : LAMPS;

        build(&order, light);
        for (unsigned k = 0; k < 4; k++) {
            ql_settings_t s = estimate_settings(QL_SAMPLER_SOBOL,
                    (uint8_t)(k < 3 ? k : 2), 1 + (uint32_t)i);

            s.direct = (uint8_t)direct;
            s.indirect = (uint8_t)(k < 3 ? QL_INDIRECT_BRDF : (unsigned)i % 3);
            check_case(&order, light, &s);
        }
    }
    NOTE("%lu pictures, off by %.4f at most", cases, worst);
}

TEST(without_direct_light_only_mirrors_before_any_wall_show_lamps)
{
    check_strategy(QL_DIRECT_NONE);
}

TEST(directions_find_each_orders_light_once)
{
    check_strategy(QL_DIRECT_HEMISPHERE);
}

TEST(cosine_directions_find_each_orders_light_once)
{
    check_strategy(QL_DIRECT_COSINE);
}

TEST(points_of_lamps_find_each_orders_light_once)
{
    check_strategy(QL_DIRECT_AREA);
}

TEST(directions_of_lamps_find_each_orders_light_once)
{
    check_strategy(QL_DIRECT_SOLID_ANGLE);
}

TEST(points_and_directions_find_each_orders_light_once)
{
    check_strategy(QL_DIRECT_MIS);
}

/* A wrong rule gives another picture, by more than the limit, of some order
 * with direct light or without. */
TEST(limits_tell_every_wrong_rule_from_the_right_one)
{
    int told[RULES] = {0};

    for (int i = 0; i < 2 * 3 * ORDERS; i++) {
        const order_t order = order_of(i % ORDERS);
        const bool direct = i / ORDERS % 2 != 0;
        const unsigned bounces = (unsigned)(i / (2 * ORDERS));
        const double right = expected(&order, direct, bounces, RIGHT);

        for (int r = RIGHT; r < RULES; r++) {
            const double wrong = expected(&order, direct, bounces, (rule_t)r);

            told[r] += fabs(wrong - right) > 2 * LIMIT * RADIANCE;
        }
    }
    for (int r = RIGHT; r < RULES; r++) {
        CHECK((told[r] > 10) == (r != RIGHT), "rule %d: told by %d", r,
                told[r]);
    }
    NOTE("by %d, %d, %d, %d pictures", told[1], told[2], told[3], told[4]);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/known_orders", argc, argv);
    RUN(without_direct_light_only_mirrors_before_any_wall_show_lamps);
    RUN(directions_find_each_orders_light_once);
    RUN(cosine_directions_find_each_orders_light_once);
    RUN(points_of_lamps_find_each_orders_light_once);
    RUN(directions_of_lamps_find_each_orders_light_once);
    RUN(points_and_directions_find_each_orders_light_once);
    RUN(limits_tell_every_wrong_rule_from_the_right_one);
    return TEST_END();
}
