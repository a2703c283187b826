/* ref_scene.c - the tables of a blob as numbers in double precision */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "ref/ref.h"
#include "scene/ql_scene.h"

static double fixed(uint32_t word, int fraction_bits)
{
    return ldexp((double)QL_LE32(word), -fraction_bits);
}

static double signed_fixed(uint32_t word, int fraction_bits)
{
    return ldexp((double)ql_i32(QL_LE32(word)), -fraction_bits);
}

static ref_vec_t wide_vector(const uint32_t v[3][2])
{
    ref_vec_t r;

    r.x = signed_fixed(v[0][1], 0) + fixed(v[0][0], 32);
    r.y = signed_fixed(v[1][1], 0) + fixed(v[1][0], 32);
    r.z = signed_fixed(v[2][1], 0) + fixed(v[2][0], 32);
    return r;
}

static ref_vec_t narrow_vector(const uint32_t v[3])
{
    const ref_vec_t r = {signed_fixed(v[0], 30), signed_fixed(v[1], 30),
            signed_fixed(v[2], 30)};

    return r;
}

static ref_vec_t from_integers(ql_vec3_t v)
{
    const ref_vec_t r = {v.x, v.y, v.z};

    return r;
}

static void read_camera(ref_scene_t *scene)
{
    const ql_blob_camera_t *c = scene->blob->camera;
    const ql_blob_lens_t *lens = scene->blob->lens;

    scene->p = wide_vector(c->at[QL_CAMERA_BASE]);
    scene->pr = wide_vector(c->at[QL_CAMERA_RIGHT]);
    scene->pu = wide_vector(c->at[QL_CAMERA_UP]);
    scene->d = narrow_vector(c->towards[QL_CAMERA_BASE]);
    scene->dr = narrow_vector(c->towards[QL_CAMERA_RIGHT]);
    scene->du = narrow_vector(c->towards[QL_CAMERA_UP]);
    for (unsigned i = 0; lens != NULL && i < 2; i++) {
        scene->lens_p[i] = wide_vector(lens->p[i]);
        scene->lens_d[i] = narrow_vector(lens->d[i]);
    }
}

static void read_materials(ref_scene_t *scene)
{
    const uint32_t count = QL_LE32(scene->blob->header->materials.count);

    scene->materials = cli_alloc(count + 1u, sizeof *scene->materials);
    for (uint32_t i = 0; i < count; i++) {
        const ql_blob_material_t *from = scene->blob->materials + i;
        const ql_blob_gloss_t *gloss = ql_scene_gloss(scene->blob, from);
        ref_material_t *to = scene->materials + i;

        for (unsigned k = 0; k < 3; k++) {
            to->albedo[k] = fixed(from->albedo[k], 31);
            to->emission[k] = fixed(from->emission[k], 32);
            to->specular[k] = gloss != NULL ? fixed(gloss->specular[k], 31) : 0;
        }
        if (gloss != NULL) {
            to->kind = QL_LE16(gloss->kind);
            to->chance = QL_LE32(gloss->chance);
            to->parameter = fixed(gloss->parameter, 16);
        }
    }
}

static void read_sphere(ref_shape_t *shape, const ql_blob_sphere_t *sphere)
{
    shape->corner.x = fixed(sphere->centre[0], 8);
    shape->corner.y = fixed(sphere->centre[1], 8);
    shape->corner.z = fixed(sphere->centre[2], 8);
    shape->radius = fixed(sphere->radius, 8);
}

static void read_triangle(
        ref_shape_t *shape, const ql_scene_t *blob, const ql_blob_tri_t *tri)
{
    const uint32_t page = (uint32_t)(QL_LE16(tri->material) >> 14) << 16;

    shape->corner = from_integers(ql_scene_corner(blob, tri, 0));
    shape->e1 = ref_sub(
            from_integers(ql_scene_corner(blob, tri, 1)), shape->corner);
    shape->e2 = ref_sub(
            from_integers(ql_scene_corner(blob, tri, 2)), shape->corner);
    shape->n = ref_cross(shape->e1, shape->e2);
    shape->smooth = blob->normals != NULL;
    for (unsigned i = 0; i < 3 && blob->normals != NULL; i++) {
        const ql_blob_normal_t *at =
                blob->normals + page + QL_LE16(tri->vertex[i]);

        shape->normal[i].x = ql_i16(QL_LE16((uint16_t)at->xyz[0]));
        shape->normal[i].y = ql_i16(QL_LE16((uint16_t)at->xyz[1]));
        shape->normal[i].z = ql_i16(QL_LE16((uint16_t)at->xyz[2]));
        shape->smooth = shape->smooth &&
                        ref_dot(shape->normal[i], shape->normal[i]) > 0;
    }
}

static void read_shapes(ref_scene_t *scene)
{
    const ql_scene_t *blob = scene->blob;
    const uint32_t count = QL_LE32(blob->header->triangles.count);

    scene->shapes = cli_alloc(count + 1u, sizeof *scene->shapes);
    for (uint32_t i = 0; i < count; i++) {
        const ql_blob_tri_t *tri = blob->triangles + i;
        const ql_blob_sphere_t *sphere = ql_scene_sphere(blob, tri);

        if (sphere != NULL) {
            read_sphere(scene->shapes + i, sphere);
        } else {
            read_triangle(scene->shapes + i, blob, tri);
        }
        scene->shapes[i].light = -1;
        scene->shapes[i].material =
                scene->materials + (QL_LE16(tri->material) & 0x3fffu);
    }
    for (uint16_t i = 0; i < blob->light_count; i++) {
        const uint16_t shape = QL_LE16(blob->lights[i].triangle);

        if (shape != QL_LIGHT_SKY) {
            scene->shapes[shape].light = i;
        }
    }
}

static void read_pair8(ref_node_t child[2], const ql_blob_pair8_t *pair)
{
    for (unsigned i = 0; i < 2; i++) {
        for (unsigned k = 0; k < 3; k++) {
            const double centre = QL_LE16(pair->base[k]) +
                                  ldexp(pair->centre[i][k], pair->shift);
            const double half = ldexp(pair->half[i][k], pair->shift);

            child[i].low[k] = centre - half;
            child[i].high[k] = centre + half;
        }
        child[i].link = QL_LE16(pair->link[i]);
        child[i].meta = i == 0 ? pair->meta & 15u : pair->meta >> 4;
    }
}

static void read_node16(ref_node_t *child, const ql_blob_node16_t *node)
{
    for (unsigned k = 0; k < 3; k++) {
        const double centre = QL_LE16(node->centre[k]);
        const double half = QL_LE16(node->half[k]);

        child->low[k] = centre - half;
        child->high[k] = centre + half;
    }
    child->link = QL_LE16(node->link);
    child->meta = QL_LE16(node->meta);
}

static void read_nodes(ref_scene_t *scene)
{
    const uint32_t count = QL_LE32(scene->blob->header->pairs.count);

    scene->nodes = cli_alloc(2 * (count + 1u), sizeof *scene->nodes);
    for (uint32_t i = 0; i < 2 * count; i++) {
        if (scene->blob->node_bits == 16) {
            read_node16(scene->nodes + i,
                    (const ql_blob_node16_t *)scene->blob->pairs + i);
        } else if (i % 2 == 0) {
            read_pair8(scene->nodes + i,
                    (const ql_blob_pair8_t *)scene->blob->pairs + i / 2);
        }
    }
}

void ref_scene_init(ref_scene_t *scene, const ql_scene_t *blob)
{
    memset(scene, 0, sizeof *scene);
    scene->blob = blob;
    scene->unit =
            ldexp(1, ql_i16(QL_LE16((uint16_t)blob->header->radiance_exp)));
    read_camera(scene);
    read_materials(scene);
    read_shapes(scene);
    read_nodes(scene);
    for (unsigned k = 0; blob->sky != NULL && k < 3; k++) {
        scene->sky[k] = fixed(blob->sky->emission[k], 32);
    }
}

void ref_scene_free(ref_scene_t *scene)
{
    free(scene->materials);
    free(scene->shapes);
    free(scene->nodes);
    memset(scene, 0, sizeof *scene);
}
