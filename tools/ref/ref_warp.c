/* ref_warp.c - the core's maps from the square, in double precision */
/* SPDX-License-Identifier: MIT */

#include "ref/ref_parts.h"

ref_vec_t ref_warp_sphere(double u1, double u2)
{
    const double rho = 2 * sqrt(u1 * (1 - u1)), phi = 2 * REF_PI * u2;
    const ref_vec_t r = {rho * cos(phi), rho * sin(phi), 1 - 2 * u1};

    return r;
}

ref_vec_t ref_warp_disk(double u1, double u2)
{
    const double a = 2 * u1 - 1, b = 2 * u2 - 1;
    const bool by_a = fabs(a) > fabs(b);
    const double angle = REF_PI / 4 * (by_a ? b / a : a / b);
    const double along = (by_a ? a : b) * cos(angle);
    const double across = (by_a ? a : b) * sin(angle);
    const ref_vec_t r = {by_a ? along : across, by_a ? across : along, 0};

    return r;
}

void ref_warp_triangle(double u1, double u2, double *b1, double *b2)
{
    *b1 = u1 < u2 ? u1 / 2 : u1 - u2 / 2;
    *b2 = u1 < u2 ? u2 - u1 / 2 : u2 / 2;
}

ref_vec_t ref_warp_about(const struct ref_rounding *rounding, ref_vec_t axis,
        double s, double u2)
{
    /* the frame of Duff et al., as ql_frame_from_normal() takes its signs */
    const double sign = axis.z < 0 ? -1 : 1;
    const double a = 1 / (1 + fabs(axis.z));
    ref_vec_t right = {
            1 - axis.x * axis.x * a, -axis.x * axis.y * a, -sign * axis.x};
    ref_vec_t up = {-sign * axis.x * axis.y * a,
            sign * (1 - axis.y * axis.y * a), -axis.y};
    const double rho = sqrt(s * (2 - s)), phi = 2 * REF_PI * u2;

    if (rounding != NULL && rounding->frame != NULL) {
        rounding->frame(rounding->data, axis, &right, &up);
    }
    return ref_along(
            ref_along(ref_scale(right, rho * cos(phi)), up, rho * sin(phi)),
            axis, 1 - s);
}

ref_vec_t ref_warp_cosine(ref_vec_t n, double u1, double u2)
{
    return ref_unit(ref_add(n, ref_warp_sphere(u1, u2)));
}

/* The corner that Arvo's construction begins at: the first, or the one from
 * which the corner before it is the farthest, if that is beyond 120 degrees. */
static unsigned first_corner(const ref_vec_t unit[3])
{
    double least = -0.5;
    unsigned first = 0;

    for (unsigned i = 0; i < 3; i++) {
        const double cosine = ref_dot(unit[(i + 2) % 3], unit[i]);

        if (cosine < least) {
            least = cosine;
            first = i;
        }
    }
    return first;
}

/* Of unit vectors (Van Oosterom and Strackee 1983). */
static double solid_angle_of(ref_vec_t a, ref_vec_t b, ref_vec_t c)
{
    const double volume = fabs(ref_dot(ref_cross(a, b), c));

    return 2 * atan2(volume, 1 + ref_dot(a, b) + ref_dot(b, c) + ref_dot(c, a));
}

bool ref_warp_spherical(const ref_vec_t corner[3], double u1, double u2,
        ref_vec_t *w, double *solid_angle)
{
    const ref_vec_t unit[3] = {
            ref_unit(corner[0]), ref_unit(corner[1]), ref_unit(corner[2])};
    const unsigned first = first_corner(unit);
    const ref_vec_t a = unit[first], b = unit[(first + 1) % 3];
    const ref_vec_t c = unit[(first + 2) % 3];
    const ref_vec_t ab = ref_cross(a, b), ac = ref_cross(a, c);
    const double area = solid_angle_of(a, b, c);
    double tangent, sine, cosine, x, y, z;
    ref_vec_t across, end;

    *solid_angle = area;
    if (!(area >= 3e-4 && area <= 6.22)) {
        return false;
    }
    /* tan of half the edge from a to b, times sine and cosine of the angle at
     * a; y is half the area that is cut off, x how far along the edge to c */
    tangent = ref_length(ab) / (1 + ref_dot(a, b));
    sine = ref_length(ref_cross(ab, ac)) / (ref_length(ab) * ref_length(ac));
    cosine = ref_dot(ab, ac) / (ref_length(ab) * ref_length(ac));
    y = u1 * area / 2;
    x = 2 * atan2(sin(y), tangent * (sine * cos(y) - cosine * sin(y)));
    across = ref_unit(ref_cross(ac, a));
    end = ref_along(ref_scale(a, cos(x)), across, sin(x));
    z = 1 - u2 * (1 - ref_dot(b, end));
    across = ref_unit(ref_along(end, b, -ref_dot(b, end)));
    *w = ref_along(ref_scale(b, z), across, sqrt(z < 1 ? 1 - z * z : 0));
    return true;
}
