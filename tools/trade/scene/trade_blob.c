/* trade_blob.c - a scene, compiled if it has to be */
/* SPDX-License-Identifier: MIT */

#include "trade/scene/trade_blob.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "lib/program/cli.h"
#include "lib/render/open_blob.h"

static bool ends_in(const char *path, const char *end)
{
    const size_t length = strlen(path), tail = strlen(end);

    return length >= tail && strcmp(path + length - tail, end) == 0;
}

bool trade_blob_is_one(const char *path)
{
    return ends_in(path, ".qlb");
}

bool trade_blob_is_source(const char *path)
{
    return ends_in(path, ".scene") || ends_in(path, ".obj");
}

/* qlux-scene beside this program. */
static char *compiler(const char *program)
{
    static const char name[] = "qlux-scene";
    const char *slash = strrchr(program, '/');
    const size_t folder = slash == NULL ? 0 : (size_t)(slash + 1 - program);
    char *path = cli_alloc(folder + sizeof name, 1);

    memcpy(path, program, folder);
    memcpy(path + folder, name, sizeof name);
    return path;
}

/* All that comes through a pipe. */
static void *drain(int from, size_t *size)
{
    size_t room = 1 << 16;
    char *bytes = NULL;

    for (*size = 0;;) {
        ssize_t got;

        bytes = realloc(bytes, room);
        if (bytes == NULL) {
            cli_fail(CLI_IO, "out of memory");
        }
        got = read(from, bytes + *size, room - *size);
        if (got == 0) {
            return bytes;
        }
        if (got < 0 && errno != EINTR) {
            cli_fail(CLI_IO, "pipe: %s", strerror(errno));
        }
        *size += got > 0 ? (size_t)got : 0;
        room += *size == room ? room : 0;
    }
}

/* The blob of a .scene or .obj. */
static void *compile(const char *path, const char *program, size_t *size)
{
    char *scene = compiler(program);
    int ends[2], status;
    void *bytes;
    pid_t child;

    if (pipe(ends) != 0 || (child = fork()) < 0) {
        cli_fail(CLI_IO, "%s: %s", scene, strerror(errno));
    }
    if (child == 0) {
        if (dup2(ends[1], STDOUT_FILENO) >= 0) {
            close(ends[0]);
            close(ends[1]);
            execlp(scene, scene, path, "-o", "-", "--quiet", (char *)NULL);
        }
        _exit(127);
    }
    close(ends[1]);
    bytes = drain(ends[0], size);
    close(ends[0]);
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            cli_fail(CLI_IO, "%s: %s", scene, strerror(errno));
        }
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) == 127) {
        cli_fail(CLI_IO, "%s: cannot be run", scene);
    }
    if (WEXITSTATUS(status) != 0) {
        cli_fail(WEXITSTATUS(status), "%s: not compiled", path);
    }
    free(scene);
    return bytes;
}

void *trade_blob_open(ql_scene_t *scene, const char *path, const char *program)
{
    size_t size;
    void *blob;

    if (!trade_blob_is_source(path)) {
        return open_blob(scene, path);
    }
    blob = compile(path, program, &size);
    open_blob_bytes(scene, blob, size, path);
    return blob;
}
