/* test_fill.c - faces of many corners are filled as their outline is drawn */
/* SPDX-License-Identifier: MIT */

/* Outlines are closed walks on a lattice, so that areas are exact; then they
 * are laid into planes that are spanned by integers. What is inside is known
 * from how an outline was made, not from a second way of filling it. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/fill/fill.h"
#include "support/ql_test.h"
#include "tools/scene/scene_worlds.h"

enum { CORNERS_MOST = 8192 };

typedef struct {
    int x, y;
} spot_t;

/* An outline, and how it lies in space: spot (x, y) is at o + x u + y v. */
typedef struct {
    spot_t at[CORNERS_MOST];
    size_t count;
    double o[3], u[3], v[3];
    double shake; /* how far corners may be off */
} outline_t;

static outline_t outline;
static world_face_t fan[CORNERS_MOST];
static size_t triangles;
static fill_faults_t faults;

/* ---- Filling ------------------------------------------------------------ */

static void begin(void)
{
    static const outline_t upright = {.u = {1, 0, 0}, .v = {0, 1, 0}};

    outline = upright;
}

static void add(int x, int y)
{
    outline.at[outline.count].x = x;
    outline.at[outline.count++].y = y;
}

/* Into one of many planes; coordinates stay exact. */
static void turn_plane(void)
{
    const double *u = outline.u, *v = outline.v;

    do {
        for (int k = 0; k < 3; k++) {
            outline.o[k] = (double)(next() % 2001) - 1000;
            outline.u[k] = (double)(next() % 41) - 20;
            outline.v[k] = (double)(next() % 41) - 20;
        }
    } while (u[0] * v[1] == u[1] * v[0] && u[1] * v[2] == u[2] * v[1] &&
             u[2] * v[0] == u[0] * v[2]);
}

static void fill(void)
{
    world_t world;

    open_world(&world);
    for (size_t i = 0; i < outline.count; i++) {
        const double x = outline.at[i].x + outline.shake * uniform();
        const double y = outline.at[i].y + outline.shake * uniform();
        double p[3];

        for (int k = 0; k < 3; k++) {
            p[k] = outline.o[k] + x * outline.u[k] + y * outline.v[k];
        }
        (void)world_add_vertex(&world, p);
    }
    triangles = outline.count - 2;
    for (uint32_t i = 0; i < triangles; i++) {
        const world_face_t face = {
                {0, i + 1, i + 2}, 7, {9, i + 10, i + 11}, 0, false};

        fan[i] = face;
    }
    triangles = fill_face(&faults, &world, fan, triangles);
    world_free(&world);
}

/* ---- What came of it ---------------------------------------------------- */

static long side(spot_t a, spot_t b, spot_t c)
{
    return (long)(b.x - a.x) * (c.y - a.y) - (long)(b.y - a.y) * (c.x - a.x);
}

static long twice_area(const world_face_t *face)
{
    return side(outline.at[face->vertex[0]], outline.at[face->vertex[1]],
            outline.at[face->vertex[2]]);
}

static long twice_outline(void)
{
    const spot_t origin = {0, 0};
    long sum = 0;

    for (size_t i = 0; i < outline.count; i++) {
        sum += side(origin, outline.at[i], outline.at[(i + 1) % outline.count]);
    }
    return sum;
}

static long twice_filled(void)
{
    long sum = 0;

    for (size_t i = 0; i < triangles; i++) {
        sum += twice_area(fan + i);
    }
    return sum;
}

static size_t count_flipped(void)
{
    size_t flipped = 0;

    for (size_t i = 0; i < triangles; i++) {
        flipped += twice_area(fan + i) <= 0;
    }
    return flipped;
}

static bool is_empty(void)
{
    bool empty = true;

    for (size_t i = 0; i < triangles; i++) {
        empty = empty && twice_area(fan + i) == 0;
    }
    return empty;
}

/* How many triangles cover a point, given in 1024ths, that is on none of their
 * sides? */
static int count_covering(spot_t p)
{
    int covering = 0;

    for (size_t i = 0; i < triangles; i++) {
        spot_t a[3];
        bool inside = true;

        for (int k = 0; k < 3; k++) {
            a[k].x = 1024 * outline.at[fan[i].vertex[k]].x;
            a[k].y = 1024 * outline.at[fan[i].vertex[k]].y;
        }
        for (int k = 0; k < 3; k++) {
            inside = inside && side(a[k], a[(k + 1) % 3], p) > 0;
        }
        covering += inside;
    }
    return covering;
}

/* Are all corners that enclose something corners of triangles, with what they
 * are and the face's material? */
static bool keeps_corners(void)
{
    bool used[CORNERS_MOST] = {false}, kept = true;

    for (size_t i = 0; i < triangles; i++) {
        for (int k = 0; k < 3; k++) {
            const uint32_t v = fan[i].vertex[k];

            used[v] = true;
            kept = kept && fan[i].normal[k] == v + 9;
        }
        kept = kept && fan[i].material == 7;
    }
    for (size_t i = 0; i < outline.count; i++) {
        kept = kept && used[i];
    }
    return kept;
}

/* ---- Islands of unit squares -------------------------------------------- */

enum { ISLAND = 12, RIGHT = 1, UP = 2, LEFT = 4, DOWN = 8 };

/* Ways to neighbours; 0 is no square. One grows from the middle, square by
 * square, so that all hang together by a tree of ways. Neighbours without a way
 * have a wall between them that the outline runs along twice, as along a bridge
 * to a hole. Holes and corners that touch come by chance. */
static unsigned island[ISLAND][ISLAND];

static const struct {
    unsigned way, back;
    int x, y;
} ways[4] = {{RIGHT, LEFT, 1, 0}, {UP, DOWN, 0, 1}, {LEFT, RIGHT, -1, 0},
        {DOWN, UP, 0, -1}};

static void grow_island(int squares)
{
    memset(island, 0, sizeof island);
    for (int n = 1; n < squares;) {
        const int x = (int)(next() % ISLAND), y = (int)(next() % ISLAND);
        const int w = (int)(next() % 4);
        const int to_x = x + ways[w].x, to_y = y + ways[w].y;
        const bool begun =
                n > 1 ? island[x][y] != 0 : x == ISLAND / 2 && y == x;

        if (begun && to_x >= 0 && to_x < ISLAND && to_y >= 0 && to_y < ISLAND &&
                island[to_x][to_y] == 0) {
            island[x][y] |= ways[w].way;
            island[to_x][to_y] |= ways[w].back;
            n++;
        }
    }
}

/* Walk along the inside of the walls, counter-clockwise in a square, and leave
 * a corner at every step. */
static void walk_island(void)
{
    static const spot_t ends[4] = {{1, 0}, {1, 1}, {0, 1}, {0, 0}};
    int x = ISLAND / 2, y = x, wall = 0;
    int first = -1;

    begin();
    for (;;) {
        /* wall w is beside the square in the direction of way w */
        while ((island[x][y] & ways[wall].way) != 0) {
            x += ways[wall].x;
            y += ways[wall].y;
            wall = (wall + 3) % 4;
        }
        if (first < 0) {
            first = (x * ISLAND + y) * 4 + wall;
        } else if (first == (x * ISLAND + y) * 4 + wall) {
            return;
        }
        /* the wall on the right goes up: it ends at (1, 1) */
        add(x + ends[(wall + 1) % 4].x, y + ends[(wall + 1) % 4].y);
        wall = (wall + 1) % 4;
    }
}

/* Leave out corners on straight sides, each with a chance of 1 - 1/keep; as the
 * two sides of a wall lose different ones, they overlap in part only. */
static void straighten(unsigned keep)
{
    static spot_t all[CORNERS_MOST];
    const size_t count = outline.count;

    memcpy(all, outline.at, count * sizeof *all);
    outline.count = 0;
    for (size_t i = 0; i < count; i++) {
        const spot_t a = all[(i + count - 1) % count], b = all[i];

        if (side(a, b, all[(i + 1) % count]) != 0 || next() % keep == 0) {
            add(b.x, b.y);
        }
    }
}

/* Is every square covered once and nothing else? No line between two corners
 * meets the places: if a x + b y = 0 modulo 1024 with |a|, |b| <= 12, then
 * a + 41 b = 0, too, as x is odd and y = 41 x. */
static bool covers_island(void)
{
    static const spot_t places[4] = {
            {1, 41}, {455, 223}, {639, 599}, {967, 735}};
    bool right = true;

    for (int x = 0; x < ISLAND; x++) {
        for (int y = 0; y < ISLAND; y++) {
            for (int i = 0; i < 4; i++) {
                const spot_t p = {
                        1024 * x + places[i].x, 1024 * y + places[i].y};

                right = right && count_covering(p) == (island[x][y] != 0);
            }
        }
    }
    return right;
}

TEST(islands_are_covered_once_to_their_walls)
{
    int wrong = 0;
    const int rounds = (int)MANY(800);

    for (int i = 0; i < rounds; i++) {
        const int squares = 2 + (int)(next() % 60);

        grow_island(squares);
        walk_island();
        turn_plane();
        fill();
        /* Pick: a lattice triangle has an area of 1/2 at least */
        wrong += outline.count != 2 * (size_t)squares + 2 ||
                 twice_filled() != 2 * squares || count_flipped() > 0 ||
                 !covers_island() || faults.crosses || faults.is_bent;
    }
    CHECK(wrong == 0, "%d of %d", wrong, rounds);
    NOTE("%d islands", rounds);
}

TEST(sides_of_a_bridge_may_have_other_corners)
{
    int wrong = 0;
    const int rounds = (int)MANY(800);

    for (int i = 0; i < rounds; i++) {
        const int squares = 2 + (int)(next() % 60);

        grow_island(squares);
        walk_island();
        straighten(1 + (unsigned)(next() % 4));
        turn_plane();
        fill();
        wrong += twice_filled() != 2 * squares || count_flipped() > 0 ||
                 !covers_island() || faults.crosses || faults.is_bent ||
                 triangles > outline.count - 2;
    }
    CHECK(wrong == 0, "%d of %d", wrong, rounds);
}

/* ---- Other shapes ------------------------------------------------------- */

/* Letters and such, each from every first corner. */
static const struct {
    const char *name;
    size_t count;
    int twice; /* the area */
    spot_t at[16];
} shapes[] = {
        {"arrow", 7, 14,
                {{0, 1}, {3, 1}, {3, 0}, {5, 2}, {3, 4}, {3, 3}, {0, 3}}},
        {"chevron", 4, 8, {{0, 0}, {4, 4}, {0, 8}, {2, 4}}},
        {"L", 6, 10, {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}},
        {"U", 8, 14,
                {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3},
                        {0, 3}}},
        {"square with a corner in a side", 5, 8,
                {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}},
        {"star", 10, 104,
                {{0, 8}, {-2, 3}, {-8, 2}, {-3, -2}, {-5, -7}, {0, -4}, {5, -7},
                        {3, -2}, {8, 2}, {2, 3}}},
};

TEST(letters_keep_area_and_corners_from_any_first_corner)
{
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        for (size_t first = 0; first < shapes[s].count; first++) {
            begin();
            for (size_t i = 0; i < shapes[s].count; i++) {
                const spot_t p = shapes[s].at[(first + i) % shapes[s].count];

                add(p.x, p.y);
            }
            turn_plane();
            fill();
            CHECK(twice_filled() == twice_outline(), "%s: %ld, not %ld",
                    shapes[s].name, twice_filled(), twice_outline());
            CHECK(count_flipped() == 0, "%s", shapes[s].name);
            CHECK(triangles == shapes[s].count - 2 && keeps_corners() &&
                            !faults.crosses && !faults.is_bent,
                    "%s", shapes[s].name);
        }
    }
}

/* A corridor that winds inwards, then back outwards beside itself. */
static void wind(int rounds)
{
    static spot_t out[CORNERS_MOST];
    size_t count = 0;

    begin();
    for (int i = 0; i < rounds; i++) {
        const int far = 4 * (rounds - i) + 4;

        add(-far, -far);
        add(far, -far);
        add(far, far);
        add(-far + 4, far);
        out[count].x = out[count].y = -far + 2;
        out[count + 1].x = far - 2;
        out[count + 1].y = -far + 2;
        out[count + 2].x = out[count + 2].y = far - 2;
        out[count + 3].x = -far + 6;
        out[count + 3].y = far - 2;
        count += 4;
    }
    while (count > 0) {
        count--;
        add(out[count].x, out[count].y);
    }
}

TEST(spirals_of_thousands_of_corners_are_filled)
{
    for (int rounds = 1; rounds <= 512; rounds *= 8) {
        wind(rounds);
        turn_plane();
        fill();
        CHECK(outline.count == 8 * (size_t)rounds && !faults.crosses,
                "%zu corners", outline.count);
        CHECK(triangles == outline.count - 2 && count_flipped() == 0 &&
                        twice_filled() == twice_outline() && keeps_corners(),
                "%zu corners: %zu triangles, %ld of %ld", outline.count,
                triangles, twice_filled(), twice_outline());
    }
}

TEST(corners_that_enclose_nothing_are_dropped)
{
    static const struct {
        size_t count, triangles;
        spot_t at[12];
    } cases[] = {/* repeated: in a row, and first and last */
            {6, 2, {{0, 0}, {0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}},
            /* spikes outwards, inwards, of two corners, along a side */
            {6, 2, {{0, 0}, {2, 0}, {5, 0}, {2, 0}, {2, 2}, {0, 2}}},
            {6, 2, {{0, 0}, {2, 0}, {1, 1}, {2, 0}, {2, 2}, {0, 2}}},
            {9, 3,
                    {{0, 0}, {2, 0}, {3, 1}, {4, 1}, {3, 1}, {2, 0}, {2, 2},
                            {1, 2}, {0, 2}}},
            {6, 3, {{0, 0}, {3, 0}, {1, 0}, {3, 0}, {3, 2}, {0, 2}}},
            {5, 2, {{0, 0}, {3, 0}, {2, 0}, {2, 2}, {0, 2}}},
            /* nothing else */
            {4, 0, {{0, 0}, {3, 0}, {1, 2}, {3, 0}}},
            {6, 0, {{0, 0}, {3, 0}, {1, 2}, {5, 5}, {1, 2}, {3, 0}}}};

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        begin();
        for (size_t k = 0; k < cases[i].count; k++) {
            add(cases[i].at[k].x, cases[i].at[k].y);
        }
        turn_plane();
        fill();
        CHECK(twice_filled() == twice_outline() && count_flipped() == 0 &&
                        !faults.crosses,
                "case %zu: %ld, not %ld", i, twice_filled(), twice_outline());
        CHECK(triangles == cases[i].triangles, "case %zu: %zu triangles", i,
                triangles);
    }
}

/* ---- Outlines that cross themselves ------------------------------------- */

static bool has_crossing(void)
{
    const size_t n = outline.count;

    for (size_t i = 0; i < n; i++) {
        const spot_t a = outline.at[i], b = outline.at[(i + 1) % n];

        for (size_t k = 0; k < i; k++) {
            const spot_t c = outline.at[k], d = outline.at[(k + 1) % n];
            const long p = side(a, b, c), q = side(a, b, d);
            const long r = side(c, d, a), s = side(c, d, b);

            if (((p < 0 && q > 0) || (p > 0 && q < 0)) &&
                    ((r < 0 && s > 0) || (r > 0 && s < 0))) {
                return true;
            }
        }
    }
    return false;
}

TEST(an_outline_that_crosses_itself_is_told_and_keeps_its_signed_area)
{
    int wrong = 0, crossing = 0;
    const int rounds = (int)MANY(20000);

    for (int i = 0; i < rounds; i++) {
        const int corners = 4 + (int)(next() % 9), wide = 2 + (int)(next() % 9);

        begin();
        for (int k = 0; k < corners; k++) {
            const int x = (int)(next() % (unsigned)wide);

            add(x, (int)(next() % (unsigned)wide));
        }
        fill();
        crossing += has_crossing();
        wrong += twice_filled() != twice_outline() ||
                 triangles > outline.count - 2 ||
                 /* what comes back the way it went may cross anything */
                 (has_crossing() && !faults.crosses && !is_empty() &&
                         triangles == outline.count - 2) ||
                 (!faults.crosses && count_flipped() > 0 &&
                         count_flipped() < triangles);
    }
    CHECK(wrong == 0, "%d of %d", wrong, rounds);
    NOTE("%d of %d cross", crossing, rounds);
}

TEST(outlines_that_go_around_twice_or_not_at_all_cross_themselves)
{
    static const struct {
        size_t count;
        spot_t at[12];
    } cases[] = {{4, {{0, 0}, {4, 4}, {4, 0}, {0, 4}}},        /* a bow-tie */
            {5, {{0, 6}, {-4, -5}, {6, 2}, {-6, 2}, {4, -5}}}, /* pentagram */
            {6, {{0, 0}, {1, 1}, {2, 2}, {2, 0}, {1, 1}, {0, 2}}},
            /* through a corner, the inner loop in the outer one */
            {6, {{0, 0}, {8, 0}, {4, 6}, {3, 3}, {5, 3}, {4, 6}}},
            {8, {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 4},
                        {0, 4}}}};

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        begin();
        for (size_t k = 0; k < cases[i].count; k++) {
            add(cases[i].at[k].x, cases[i].at[k].y);
        }
        turn_plane();
        fill();
        CHECK(i == 3 || faults.crosses, "case %zu", i);
        CHECK(twice_filled() == twice_outline(), "case %zu: %ld, not %ld", i,
                twice_filled(), twice_outline());
    }
}

/* ---- Faces that are not flat -------------------------------------------- */

/* Twice the area of a triangle; its normal is added to a sum. */
static double add_cross(
        double sum[3], const world_t *world, const world_face_t *face)
{
    const double *p = world->vertices[face->vertex[0]];
    const double *q = world->vertices[face->vertex[1]];
    const double *r = world->vertices[face->vertex[2]];
    double square = 0;

    for (int k = 0; k < 3; k++) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        const double n =
                (q[x] - p[x]) * (r[y] - p[y]) - (q[y] - p[y]) * (r[x] - p[x]);

        sum[k] += n;
        square += n * n;
    }
    return sqrt(square);
}

/* A unit square two of whose corners are lifted. */
static void fill_bent(double lift)
{
    static const double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    world_t world;

    open_world(&world);
    for (int i = 0; i < 4; i++) {
        const double p[3] = {
                corners[i][0], corners[i][1], i % 2 == 0 ? 0 : lift};

        (void)world_add_vertex(&world, p);
    }
    for (uint32_t i = 0; i < 2; i++) {
        const world_face_t face = {{0, i + 1, i + 2}, 0, {0, 0, 0}, 0, false};

        fan[i] = face;
    }
    triangles = fill_face(&faults, &world, fan, 2);
    world_free(&world);
}

TEST(squares_bent_by_more_than_20_degrees_are_told)
{
    /* corners 1 and 3 are lifted by h: a half turns by atan(h sqrt 2) */
    const double ten = tan(10 * 3.14159265358979323846 / 180) / sqrt(2);

    fill_bent(0);
    CHECK(!faults.is_bent, "flat");
    fill_bent(0.99 * ten);
    CHECK(!faults.is_bent && triangles == 2, "below");
    fill_bent(-0.99 * ten);
    CHECK(!faults.is_bent, "below, the other way");
    fill_bent(1.01 * ten);
    CHECK(faults.is_bent && !faults.crosses && triangles == 2, "above");
    CHECK(fan[0].vertex[1] == 1 && fan[1].vertex[1] == 2, "stays a fan");
}

/* Real outlines with concave corners, in any plane, far from the origin, of
 * doubles: their corners are not quite in a plane. */
TEST(real_outlines_far_away_keep_their_area)
{
    double worst = 0;
    int wrong = 0;

    for (int i = 0; i < (int)MANY(200); i++) {
        const size_t n = 5 + next() % 60;
        const double height = 1000 * uniform(), size = pow(10, 4 * uniform());
        double sum[3] = {0, 0, 0}, area = 0, is;
        world_t world;

        open_world(&world);
        for (size_t k = 0; k < n; k++) {
            const double angle =
                    2 * 3.14159265358979323846 * (double)k / (double)n;
            const double r = size * (0.1 + uniform());
            const double x = 1e4 + r * cos(angle), y = -2e4 + r * sin(angle);
            const double p[3] = {x, height * y, y - 0.7 * x};

            (void)world_add_vertex(&world, p);
        }
        for (uint32_t k = 0; k < n - 2; k++) {
            const world_face_t face = {
                    {0, k + 1, k + 2}, 0, {0, 0, 0}, 0, false};

            fan[k] = face;
            (void)add_cross(sum, &world, &face);
        }
        is = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
        triangles = fill_face(&faults, &world, fan, n - 2);
        for (size_t k = 0; k < triangles; k++) {
            double cross[3] = {0, 0, 0};

            area += add_cross(cross, &world, fan + k);
            wrong +=
                    cross[0] * sum[0] + cross[1] * sum[1] + cross[2] * sum[2] <=
                    0;
        }
        worst = fmax(worst, fabs(area / is - 1));
        wrong += triangles != n - 2 || faults.crosses || faults.is_bent;
        world_free(&world);
    }
    CHECK(wrong == 0, "%d", wrong);
    CHECK(worst < 1e-11, "%g", worst);
    NOTE("off by %.1e at most", worst);
}

TEST(bridges_that_rounding_takes_apart_are_closed)
{
    int wrong = 0;
    const int rounds = (int)MANY(400);

    for (int i = 0; i < rounds; i++) {
        const int squares = 2 + (int)(next() % 60);

        grow_island(squares);
        walk_island();
        straighten(1 + (unsigned)(next() % 4));
        turn_plane();
        outline.shake = pow(10, -6 - 6 * uniform());
        fill();
        /* what is left of the gaps has no area where the corners belong */
        wrong += twice_filled() != 2 * squares || !covers_island() ||
                 faults.crosses || faults.is_bent;
    }
    CHECK(wrong == 0, "%d of %d", wrong, rounds);
}

static double round_to(double x, double step)
{
    return step * floor(x / step + 0.5);
}

/* The smallest height of a triangle. */
static double find_thinnest(const world_t *world)
{
    double least = INFINITY;

    for (size_t i = 0; i < triangles; i++) {
        double sum[3] = {0, 0, 0}, longest = 0;
        const double area = add_cross(sum, world, fan + i);

        for (int a = 0; a < 3; a++) {
            const double *p = world->vertices[fan[i].vertex[a]];
            const double *q = world->vertices[fan[i].vertex[(a + 1) % 3]];
            double square = 0;

            for (int k = 0; k < 3; k++) {
                square += (p[k] - q[k]) * (p[k] - q[k]);
            }
            longest = fmax(longest, sqrt(square));
        }
        least = fmin(least, area / longest);
    }
    return least;
}

/* A square, tilted, with corners along its sides that six digits have moved. */
TEST(corners_nearly_in_a_side_make_no_thin_triangles)
{
    double least = INFINITY;
    int wrong = 0;

    for (int round = 0; round < (int)MANY(100); round++) {
        const uint32_t a_side = 2 + (uint32_t)(next() % 10);
        uint32_t n = 0;
        const double slope = uniform();
        world_t world;

        open_world(&world);
        for (uint32_t i = 0; i < 4 * a_side; i++) {
            static const double at[5][2] = {
                    {0, 0}, {1, 0.2}, {0.8, 1.2}, {-0.2, 1}, {0, 0}};
            const uint32_t side = i / a_side;
            const double t = (double)(i % a_side) / a_side;
            const double x = at[side][0] * (1 - t) + at[side + 1][0] * t;
            const double y = at[side][1] * (1 - t) + at[side + 1][1] * t;
            const double p[3] = {round_to(x, 1e-6), round_to(y, 1e-6),
                    round_to(slope * x - 0.4 * y, 1e-6)};

            if (i % a_side == 0 || next() % 4 == 0) {
                (void)world_add_vertex(&world, p);
                n++;
            }
        }
        for (uint32_t i = 0; i < n - 2; i++) {
            const world_face_t face = {
                    {0, i + 1, i + 2}, 0, {0, 0, 0}, 0, false};

            fan[i] = face;
        }
        triangles = fill_face(&faults, &world, fan, n - 2);
        wrong += triangles != n - 2 || faults.crosses || faults.is_bent;
        least = fmin(least, find_thinnest(&world));
        world_free(&world);
    }
    CHECK(wrong == 0, "%d", wrong);
    CHECK(least > 1e-3, "%g", least);
    NOTE("%.4f wide at least", least);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/fill", argc, argv);
    RUN(islands_are_covered_once_to_their_walls);
    RUN(sides_of_a_bridge_may_have_other_corners);
    RUN(bridges_that_rounding_takes_apart_are_closed);
    RUN(letters_keep_area_and_corners_from_any_first_corner);
    RUN(spirals_of_thousands_of_corners_are_filled);
    RUN(corners_that_enclose_nothing_are_dropped);
    RUN(an_outline_that_crosses_itself_is_told_and_keeps_its_signed_area);
    RUN(outlines_that_go_around_twice_or_not_at_all_cross_themselves);
    RUN(squares_bent_by_more_than_20_degrees_are_told);
    RUN(real_outlines_far_away_keep_their_area);
    RUN(corners_nearly_in_a_side_make_no_thin_triangles);
    return TEST_END();
}
