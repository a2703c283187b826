/* qlux.c - the whole core as one file to compile */
/* SPDX-License-Identifier: MIT */

/* A firmware may add this one file in place of the core's many, with firmware/
 * among its folders of headers and its gates as -D flags. The compiler sees
 * everything at once and needs half the time; the bits of a picture are the
 * same. That is why no two files of the core have a file-scope name in common.
 * The layers are in their order, lowest first. */

#include "base/ql_crc.c"
#include "base/ql_status.c"

#include "math/lut/ql_lut_data.c"
#include "math/ql_fx.c"
#include "math/ql_real.c"
#include "math/ql_trig.c"
#include "math/vec/ql_frame.c"
#include "math/vec/ql_rgb.c"
#include "math/vec/ql_vec.c"
#include "math/vec/ql_vec_unit.c"

#include "sample/ql_roulette.c"
#include "sample/ql_sampler.c"
#include "sample/ql_table.c"

#include "warp/lecture/ql_warp_lecture.c"
#include "warp/ql_warp_cone.c"
#include "warp/ql_warp_hemisphere.c"
#include "warp/ql_warp_lobe.c"
#include "warp/ql_warp_plane.c"
#include "warp/ql_warp_sphere.c"
#include "warp/ql_warp_spherical.c"

#include "scene/ql_camera.c"
#include "scene/ql_lens.c"

#include "blob/ql_blob_basic.c"
#include "blob/ql_blob_distributions.c"
#include "blob/ql_blob_gloss.c"
#include "blob/ql_blob_lens.c"
#include "blob/ql_blob_open.c"
#include "blob/ql_blob_sky.c"
#include "blob/ql_blob_sky_map.c"
#include "blob/ql_blob_smooth.c"
#include "blob/ql_blob_spheres.c"
#include "blob/ql_blob_tree.c"

#include "trace/ql_bvh.c"
#include "trace/ql_hull.c"
#include "trace/ql_hull_slanted.c"
#include "trace/ql_order.c"
#include "trace/ql_sphere.c"
#include "trace/surface/ql_contact.c"
#include "trace/surface/ql_shading.c"
#include "trace/surface/ql_smooth.c"
#include "trace/surface/ql_surface_at.c"

#include "material/ql_bsdf.c"
#include "material/ql_diffuse.c"
#include "material/ql_glass.c"
#include "material/ql_mirror.c"
#include "material/ql_phong.c"

#include "light/ql_emit.c"
#include "light/ql_emit_sky.c"
#include "light/ql_emit_sphere.c"
#include "light/ql_emit_triangle.c"
#include "light/ql_light.c"
#include "light/sky/ql_sky_map.c"

#include "film/ql_adaptive.c"
#include "film/ql_clamp.c"
#include "film/ql_curve.c"
#include "film/ql_film.c"
#include "film/ql_meter.c"
#include "film/ql_tonemap.c"

#include "render/ql_emitted.c"
#include "render/ql_line.c"
#include "render/ql_mis.c"
#include "render/ql_next_event.c"
#include "render/ql_path.c"
