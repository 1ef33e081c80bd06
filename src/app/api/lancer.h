/* lancer as a library, for C and whatever calls C. What it draws has the bits of `lancer render`.
 *
 *     lancer_scene* scene = lancer_scene_open("room.toml");
 *     uint32_t width, height;
 *     if (lancer_scene_size(scene, &width, &height) == LANCER_OK) {
 *         float* color = malloc(sizeof(float) * 3 * width * height);
 *         lancer_layer layer = {"color", color, 3 * (size_t)width * height};
 *         if (lancer_scene_render(scene, &layer, 1, 0, NULL, NULL) != LANCER_OK) puts(lancer_error());
 *     }
 *     lancer_scene_free(scene);
 *
 * A scene is for one thread at a time; scenes do not know each other. Nothing is printed. All text is UTF-8. */
#ifndef LANCER_H
#define LANCER_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define LANCER_API __attribute__((visibility("default")))
#else
#define LANCER_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Grows when something here changes its meaning; what is added leaves it as it is. */
#define LANCER_API_VERSION 1

/* What functions return; the program's exit codes. */
enum {
    LANCER_OK = 0,
    LANCER_FAILED = 1,         /* at run time: memory, threads */
    LANCER_USAGE = 2,          /* an argument is wrong */
    LANCER_INVALID_INPUT = 65, /* a scene or one of its files is wrong */
    LANCER_MISSING_INPUT = 66, /* a file does not exist */
    LANCER_NO_MEMORY = 71,     /* the pictures of a scene need more memory than there is */
    LANCER_CANCELLED = 130     /* progress said so */
};

/* The version of the library, "1.2.3"; LANCER_API_VERSION of the library, which may differ from that of this file. */
LANCER_API const char* lancer_version(void);
LANCER_API int lancer_api_version(void);

/* What the last failure of this thread was: lines "place: error: message"; "" if there was none. Valid until the next
 * call of this thread. */
LANCER_API const char* lancer_error(void);

typedef struct lancer_scene lancer_scene;

/* A scene file or a mesh, as on the command line. Nothing is read before its size or picture is asked for. Null: no
 * memory. */
LANCER_API lancer_scene* lancer_scene_open(const char* file);
/* A scene file in memory. folder: where the files are that it names; null: the working folder. */
LANCER_API lancer_scene* lancer_scene_from_text(const char* toml, const char* folder);
/* Null is ignored. */
LANCER_API void lancer_scene_free(lancer_scene* scene);

/* Puts a definition over the scene file, as the option -D does: "render.spp=64", "camera.fov=30". What was rendered so
 * far is not affected. */
LANCER_API int lancer_scene_define(lancer_scene* scene, const char* definition);

/* Triangles in memory, copied by the call. */
typedef struct {
    const char* name;           /* for instances and layers; null: none */
    const char* material;       /* the name of a [material.NAME] or a preset; null: the default grey */
    const double* positions;    /* 3 numbers for each vertex, finite */
    size_t vertices;            /* > 0, < 2^32 */
    const uint32_t* triangles;  /* 3 indices of vertices for each triangle, counter-clockwise from its front */
    size_t triangle_count;      /* > 0 */
    const float* normals;       /* null, or 3 numbers for each vertex: shading normals of any length */
    const float* uvs;           /* null, or 2 numbers for each vertex, v upwards */
} lancer_mesh;
LANCER_API int lancer_scene_add_mesh(lancer_scene* scene, const lancer_mesh* mesh);

/* Pixels of the picture. Reads the scene, if that has not been done. */
LANCER_API int lancer_scene_size(lancer_scene* scene, uint32_t* width, uint32_t* height);
/* What is doubtful in the scene, a line each; "" if nothing is, or before the scene has been read. Valid until the next
 * call with this scene. */
LANCER_API const char* lancer_scene_warnings(const lancer_scene* scene);

/* Numbers for each pixel of a layer: 3 of "color" (linear Rec. 709 radiance), "albedo", "normal", "position" and "flat",
 * 2 of "uv", 1 of "depth", "z", "mask", "material", "variance" and "samples": docs/aovs.md. 0: there is no such layer. */
LANCER_API size_t lancer_layer_channels(const char* name);

typedef struct {
    const char* name;
    float* values; /* rows from the top, pixels from the left, channels together */
    size_t count;  /* width * height * channels */
} lancer_layer;
/* Called now and then, never by two threads at once, with the part that is done, in [0, 1], which grows. Not 0: the
 * render is to stop. */
typedef int (*lancer_progress)(void* user, double done);

/* Renders the scene with all its samples and fills the layers. threads: 0 for all. progress: may be null. After a
 * failure the layers hold what they held before. */
LANCER_API int lancer_scene_render(lancer_scene* scene, const lancer_layer* layers, size_t layer_count,
                                   unsigned threads, lancer_progress progress, void* user);

#ifdef __cplusplus
}
#endif
#endif
