/* open_blob.c - read a scene blob and open it, or say what is wrong with it */
/* SPDX-License-Identifier: MIT */

#include "lib/render/open_blob.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/ql_crc.h"
#include "base/ql_settings.h"
#include "lib/files/kind.h"
#include "lib/program/cli.h"
#include "blob/ql_blob_open.h"

#define AT(field) offsetof(ql_blob_header_t, field)

/* Where in a blob a fault lies, and what should be there. */
typedef struct {
    size_t byte;
    char expected[120];
} fault_t;

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static fault_t
fault_at(size_t byte, const char *format, ...)
{
    fault_t fault;
    va_list arguments;

    fault.byte = byte;
    va_start(arguments, format);
    vsnprintf(fault.expected, sizeof fault.expected, format, arguments);
    va_end(arguments);
    return fault;
}

static fault_t find_version(const ql_blob_header_t *h)
{
    const unsigned version = QL_LE16(h->version);

    if (version != QL_BLOB_VERSION) {
        return fault_at(AT(version), "expected version %u, found %u",
                QL_BLOB_VERSION, version);
    }
    return fault_at(AT(header_bytes),
            "expected the tables of its features, found a header of %u bytes",
            (unsigned)QL_LE16(h->header_bytes));
}

static fault_t find_end(const ql_blob_header_t *h, size_t size)
{
    if (size < sizeof *h) {
        return fault_at(size, "expected a header of %zu bytes", sizeof *h);
    }
    return fault_at(AT(size_bytes), "expected %lu bytes, found %zu",
            (unsigned long)QL_LE32(h->size_bytes), size);
}

static fault_t find_checksum(const ql_blob_header_t *h)
{
    const uint32_t bytes = QL_LE32(h->size_bytes);
    const uint32_t crc = ql_crc32(
            0, (const uint8_t *)h + QL_BLOB_CRC_FROM, bytes - QL_BLOB_CRC_FROM);

    return fault_at(AT(crc32), "expected %08lx, found %08lx",
            (unsigned long)crc, (unsigned long)QL_LE32(h->crc32));
}

/* The first number of the header that no blob may have; or what lies behind the
 * header, where only the core knows which number it is. */
static fault_t find_range(const ql_blob_header_t *h)
{
    const uint32_t nodes = QL_LE32(h->features) &
                           (uint32_t)(QL_FEATURE_NODE16 | QL_FEATURE_NODE8);
    const int exponent = ql_i16(QL_LE16((uint16_t)h->radiance_exp));
    const struct {
        size_t byte;
        long found, min, max;
    } numbers[] = {{AT(root_meta), QL_LE16(h->root_meta), 0, 3 + QL_LEAF_MAX},
            {AT(radiance_exp), exponent, -64, 64},
            {AT(image_width), QL_LE16(h->image_width), 1, QL_IMAGE_MAX},
            {AT(image_height), QL_LE16(h->image_height), 1, QL_IMAGE_MAX},
            {AT(auto_direct), h->auto_direct, 0, QL_DIRECT_MIS},
            {AT(auto_lights), h->auto_lights, 0, QL_LIGHTS_UNIFORM}};
    const ql_blob_table_t *table = &h->camera;

    if (QL_LE32(h->size_bytes) < sizeof *h || QL_LE32(h->size_bytes) % 4 != 0) {
        return fault_at(AT(size_bytes), "expected a multiple of 4, %zu or more",
                sizeof *h);
    }
    if (nodes != QL_FEATURE_NODE16 && nodes != QL_FEATURE_NODE8) {
        return fault_at(AT(features), "expected node16 or node8");
    }
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        if (numbers[i].found < numbers[i].min ||
                numbers[i].found > numbers[i].max) {
            return fault_at(numbers[i].byte, "expected %ld to %ld, found %ld",
                    numbers[i].min, numbers[i].max, numbers[i].found);
        }
    }
    for (; table <= &h->lights; table++) {
        const uint32_t offset = QL_LE32(table->offset);

        if (offset % 4 != 0 || offset < QL_LE16(h->header_bytes) ||
                offset > QL_LE32(h->size_bytes)) {
            return fault_at((size_t)((const char *)table - (const char *)h),
                    "expected an offset in the blob, a multiple of 4, found "
                    "%lu",
                    (unsigned long)offset);
        }
    }
    return fault_at(QL_LE16(h->header_bytes),
            "expected tables as BLOB.md has them from here on");
}

static fault_t find_fault(ql_status_t status, const void *blob, size_t size)
{
    const ql_blob_header_t *h = blob;

    switch (status) {
    case QL_ERR_MAGIC:
        return fault_at(AT(magic), "expected \"QLUX\"");
    case QL_ERR_VERSION:
        return find_version(h);
    case QL_ERR_TRUNCATED:
        return find_end(h, size);
    case QL_ERR_CHECKSUM:
        return find_checksum(h);
    case QL_ERR_FEATURE:
        return fault_at(AT(features), "%s", ql_blob_missing(blob));
    case QL_ERR_CAPACITY:
        return fault_at(AT(depth), "expected a depth of %u or less, found %u",
                (unsigned)QL_CFG_BVH_STACK, (unsigned)QL_LE16(h->depth));
    case QL_ERR_RANGE:
        return find_range(h);
    default:
        return fault_at(0, "expected a blob");
    }
}

void open_blob_bytes(
        ql_scene_t *scene, const void *blob, size_t size, const char *name)
{
    const ql_status_t status = ql_blob_open(scene, blob, size);
    fault_t fault;

    if (status == QL_ERR_MAGIC || status == QL_ERR_TRUNCATED) {
        kind_refuse(name, blob, size, KIND_BLOB);
    }
    if (status != QL_OK) {
        fault = find_fault(status, blob, size);
        cli_fail(CLI_INPUT, "%s: byte %zu: %s: %s", name, fault.byte,
                ql_status_text(status), fault.expected);
    }
}

void *open_blob(ql_scene_t *scene, const char *path)
{
    size_t size;
    void *blob = cli_read(path, &size);

    open_blob_bytes(scene, blob, size, path);
    return blob;
}
