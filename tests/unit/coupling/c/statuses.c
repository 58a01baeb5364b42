/* SPDX-License-Identifier: BSD-3-Clause */
/*
 * client.h as strict C99 sees it. test_client_c.py runs it against servers that misbehave.
 *
 * Usage: statuses                              the mistakes of a program, without a server
 *        statuses no-memory                    a failure inside the library
 *        statuses <endpoint> <status>          a session, of which the first failure must have that status
 *        statuses <endpoint> iterated          a session whose steps are made twice
 */
#if defined(__linux__) && !defined(_DEFAULT_SOURCE)
#define _DEFAULT_SOURCE /* setrlimit */
#endif
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "gimdem/coupling/client.h"

static int failures = 0;

static void check(int condition, const char* what, int line)
{
    if (condition) return;
    ++failures;
    printf("line %d: %s; last error: %s\n", line, what, gimdem_client_last_error());
}

#define EXPECT(condition) check(condition, #condition, __LINE__)
/* The call fails with that status, and the words name `part`. */
#define EXPECT_ERROR(call, status, part)                                         \
    do                                                                           \
    {                                                                            \
        EXPECT((call) == (status));                                              \
        EXPECT(strstr(gimdem_client_last_error(), (part)) != NULL);              \
    } while (0)

/* One cube. */
static const double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
static const int32_t face_offsets[] = {0, 4, 8, 12, 16, 20, 24};
static const int32_t face_points[] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
static const int32_t owner[] = {0, 0, 0, 0, 0, 0};
static const gimdem_patch walls = {"walls", GIMDEM_PATCH_WALL, 0, 6, 0};
static const double zeros[9] = {0};

static gimdem_mesh cube(void)
{
    gimdem_mesh mesh = {0};
    mesh.struct_size = sizeof mesh;
    mesh.points = points;
    mesh.face_offsets = face_offsets;
    mesh.face_points = face_points;
    mesh.owner = owner;
    mesh.patches = &walls;
    mesh.point_count = 8;
    mesh.face_count = 6;
    mesh.patch_count = 1;
    mesh.cell_count = 1;
    return mesh;
}

static gimdem_fluid_fields rest(void)
{
    gimdem_fluid_fields fluid = {0};
    fluid.struct_size = sizeof fluid;
    fluid.cell_count = 1;
    fluid.velocity = zeros;
    fluid.velocity_gradient = zeros;
    fluid.pressure_gradient = zeros;
    fluid.void_fraction_gradient = zeros;
    fluid.pressure = zeros;
    return fluid;
}

static gimdem_client* make_client(const char* endpoint)
{
    gimdem_client_options options;
    gimdem_client* client = NULL;
    EXPECT(gimdem_client_options_init(&options, sizeof options) == GIMDEM_OK);
    options.endpoint = endpoint;
    options.name = "statuses";
    options.timeout = 1;
    options.connect_time = 5;
    EXPECT(gimdem_client_create(&options, &client) == GIMDEM_OK);
    return client;
}

/* A handle, an address or a struct that is absent; calls out of order. */
static void check_absent(void)
{
    gimdem_client* client = make_client("ipc:///tmp/nobody");
    gimdem_mesh mesh = cube();
    const gimdem_step step = {sizeof step, 1, 0, 1};
    const gimdem_fluid_fields fluid = rest();
    gimdem_solid_fields solid = {0};
    int32_t major = -1, minor = -1;
    const char* reason = "unset";
    solid.struct_size = sizeof solid;

    EXPECT(gimdem_client_protocol(&major, &minor) == GIMDEM_OK && major == 1 && minor >= 0);
    EXPECT_ERROR(gimdem_client_protocol(NULL, &minor), GIMDEM_ERROR_USER, "major is NULL");
    EXPECT_ERROR(gimdem_client_options_init(NULL, 0), GIMDEM_ERROR_USER, "gimdem_client_options is NULL");
    EXPECT(gimdem_client_destroy(client) == GIMDEM_OK);
    EXPECT_ERROR(gimdem_client_create(NULL, &client), GIMDEM_ERROR_USER, "NULL");
    EXPECT(client == NULL);
    EXPECT_ERROR(gimdem_client_create(NULL, NULL), GIMDEM_ERROR_USER, "NULL");
    EXPECT_ERROR(gimdem_client_connect(NULL, NULL, NULL), GIMDEM_ERROR_USER, "the client is NULL");
    EXPECT_ERROR(gimdem_client_finish(NULL, "x"), GIMDEM_ERROR_USER, "the client is NULL");
    EXPECT(gimdem_client_destroy(NULL) == GIMDEM_OK);

    client = make_client("ipc:///tmp/nobody");
    EXPECT_ERROR(gimdem_client_send_mesh(client, &mesh), GIMDEM_ERROR_USER, "illegal");
    EXPECT_ERROR(gimdem_client_begin_step(client, &step, &fluid, NULL, 0, &solid), GIMDEM_ERROR_USER, "illegal");
    EXPECT_ERROR(gimdem_client_begin_step(client, &step, &fluid, NULL, 1, &solid), GIMDEM_ERROR_USER, "monitors");
    EXPECT_ERROR(gimdem_client_begin_step(client, &step, &fluid, NULL, 0, NULL), GIMDEM_ERROR_USER, "solid_fields");
    EXPECT_ERROR(gimdem_client_end_step(client, NULL), GIMDEM_ERROR_USER, "illegal");
    EXPECT_ERROR(gimdem_client_stop_request(client, NULL), GIMDEM_ERROR_USER, "the reason is NULL");
    EXPECT(gimdem_client_stop_request(client, &reason) == GIMDEM_OK && reason == NULL);
    EXPECT(gimdem_client_solid(client, &solid) == GIMDEM_OK && solid.void_fraction == NULL);
    mesh.face_points = NULL;
    EXPECT_ERROR(gimdem_client_send_mesh(client, &mesh), GIMDEM_ERROR_USER, "face_points");
    mesh = cube();
    mesh.face_count = (size_t)-1;
    EXPECT_ERROR(gimdem_client_send_mesh(client, &mesh), GIMDEM_ERROR_USER, "faces");
    EXPECT(gimdem_client_abort(client, "done") == GIMDEM_OK);
    EXPECT(gimdem_client_destroy(client) == GIMDEM_OK);
}

static void check_options(void)
{
    const char* const unknown = "color";
    gimdem_client_options options;
    gimdem_client* client;
    gimdem_client_options_init(&options, sizeof options);
    EXPECT(options.timeout == 30 && options.connect_time == 60 && options.step_time == 3600);
    EXPECT_ERROR(gimdem_client_create(&options, &client), GIMDEM_ERROR_USER, "name");
    options.name = "statuses";
    options.endpoint = "tcp://10.0.0.1:5570";
    EXPECT(gimdem_client_create(&options, &client) == GIMDEM_OK);
    {
        const gimdem_fluid_properties fluid = {sizeof fluid, 1, 1e-5};
        EXPECT_ERROR(gimdem_client_connect(client, &fluid, NULL), GIMDEM_ERROR_ENDPOINT, "10.0.0.1");
    }
    gimdem_client_destroy(client);
    options.wants = &unknown;
    options.want_count = 1;
    EXPECT_ERROR(gimdem_client_create(&options, &client), GIMDEM_ERROR_USER, "color");
    options.want_count = 0;
    options.schedule = 7;
    EXPECT_ERROR(gimdem_client_create(&options, &client), GIMDEM_ERROR_USER, "schedule is 7");
    options.schedule = GIMDEM_SCHEDULE_SERIAL;
    options.timeout = NAN;
    EXPECT_ERROR(gimdem_client_create(&options, &client), GIMDEM_ERROR_USER, "timeout");
}

/* A struct that was compiled with another version of the header. */
static void check_sizes(void)
{
    struct
    {
        gimdem_client_options known;
        double added;
    } newer;
    gimdem_client_options options;
    gimdem_client* client;
    memset(&newer, 0xff, sizeof newer);
    EXPECT(gimdem_client_options_init(&newer.known, sizeof newer) == GIMDEM_OK);
    EXPECT(newer.known.struct_size == sizeof newer && newer.added == 0);
    newer.known.name = "statuses";
    newer.known.endpoint = "ipc:///tmp/nobody";
    EXPECT(gimdem_client_create(&newer.known, &client) == GIMDEM_OK);
    gimdem_client_destroy(client);
    newer.added = 1;
    EXPECT_ERROR(gimdem_client_create(&newer.known, &client), GIMDEM_ERROR_USER, "newer");

    EXPECT_ERROR(gimdem_client_options_init(&options, 8), GIMDEM_ERROR_USER, "struct_size is 8");
    gimdem_client_options_init(&options, sizeof options);
    options.struct_size = 0;
    EXPECT_ERROR(gimdem_client_create(&options, &client), GIMDEM_ERROR_USER, "struct_size is 0");
}

/* No memory for a copy of the name. */
static void check_no_memory(void)
{
    const size_t size = (size_t)1 << 28;
    char* name = malloc(size);
    struct rlimit limit = {(rlim_t)400 << 20, (rlim_t)400 << 20};
    gimdem_client_options options;
    gimdem_client* client;
    if (name == NULL) return;
    memset(name, 'x', size);
    name[size - 1] = 0;
    gimdem_client_options_init(&options, sizeof options);
    options.name = name;
    options.endpoint = "ipc:///tmp/nobody";
    EXPECT(setrlimit(RLIMIT_AS, &limit) == 0);
    EXPECT_ERROR(gimdem_client_create(&options, &client), GIMDEM_ERROR_INTERNAL, "alloc");
    EXPECT(client == NULL);
    free(name);
}

static void check_checkpoint(gimdem_client* client)
{
    gimdem_saved_checkpoint saved = {0};
    EXPECT_ERROR(gimdem_client_save_checkpoint(client, 1e-3, 0, NULL), GIMDEM_ERROR_USER, "saved_checkpoint is NULL");
    saved.struct_size = sizeof saved;
    EXPECT(gimdem_client_save_checkpoint(client, 1e-3, 0, &saved) == GIMDEM_OK);
    EXPECT(saved.step == 1 && saved.time == 1e-3 && saved.session != 0 && strcmp(saved.name, "none.h5") == 0);
}

/* After the first step, which must succeed: mistakes that end nothing. */
static void check_mistakes_in_session(gimdem_client* client, gimdem_solid_fields* solid)
{
    const double not_a_number[3] = {0, NAN, 0};
    const gimdem_step step = {sizeof step, 2, 1e-3, 1e-3};
    gimdem_fluid_fields fluid = rest();
    gimdem_exchange_times times = {0};
    times.struct_size = sizeof times;
    fluid.velocity = not_a_number;
    EXPECT_ERROR(gimdem_client_begin_step(client, &step, &fluid, NULL, 0, solid), GIMDEM_ERROR_USER, "velocity");
    fluid = rest();
    fluid.cell_count = 2;
    EXPECT_ERROR(gimdem_client_begin_step(client, &step, &fluid, NULL, 0, solid), GIMDEM_ERROR_USER, "numbers");
    fluid = rest();
    fluid.pressure = NULL;
    EXPECT_ERROR(gimdem_client_begin_step(client, &step, &fluid, NULL, 0, solid), GIMDEM_ERROR_USER, "pressure");
    EXPECT(gimdem_client_exchange_times(client, &times) == GIMDEM_OK && times.bytes > 0);
}

/* Returns the first failure that ends the session. */
static gimdem_status session(gimdem_client* client)
{
    const gimdem_fluid_properties properties = {sizeof properties, 1.2, 1.8e-5};
    const gimdem_monitor monitor = {"steps", "1", 1};
    const gimdem_timings timings = {sizeof timings, 0.1, 0, 0};
    const gimdem_fluid_fields fluid = rest();
    const gimdem_mesh mesh = cube();
    gimdem_welcome welcome = {0};
    gimdem_solid_fields solid = {0};
    gimdem_status status;
    int64_t n;
    welcome.struct_size = sizeof welcome;
    solid.struct_size = sizeof solid;
    if ((status = gimdem_client_connect(client, &properties, &welcome)) != GIMDEM_OK) return status;
    EXPECT(welcome.schedule == GIMDEM_SCHEDULE_SERIAL && welcome.need_count == 5);
    EXPECT(strcmp(welcome.title, "a mock without particles") == 0);
    EXPECT(strcmp(welcome.server, "gimdem-mock-server") == 0 && strcmp(welcome.needs[0], "velocity") == 0);
    if ((status = gimdem_client_send_mesh(client, &mesh)) != GIMDEM_OK) return status;
    for (n = 1; n <= 5; ++n)
    {
        const gimdem_step step = {sizeof step, n, 1e-3 * (double)(n - 1), 1e-3};
        if ((status = gimdem_client_begin_step(client, &step, &fluid, &monitor, 1, &solid)) != GIMDEM_OK) return status;
        EXPECT(solid.cell_count == 1 && solid.void_fraction[0] == 0.6 && solid.momentum_source == NULL);
        if ((status = gimdem_client_end_step(client, &timings)) != GIMDEM_OK) return status;
        if (n == 1) check_mistakes_in_session(client, &solid);
        if (n == 1) check_checkpoint(client);
    }
    return gimdem_client_finish(client, "all steps done");
}

/* Every step is repeated once. */
static void check_iterated(const char* endpoint)
{
    const gimdem_fluid_properties properties = {sizeof properties, 1.2, 1.8e-5};
    const gimdem_step step = {sizeof step, 1, 0, 1e-3};
    const gimdem_fluid_fields fluid = rest();
    const gimdem_mesh mesh = cube();
    gimdem_client_options options;
    gimdem_welcome welcome = {0};
    gimdem_solid_fields solid = {0};
    gimdem_timings timings = {0};
    gimdem_client* client = NULL;
    welcome.struct_size = sizeof welcome;
    solid.struct_size = sizeof solid;
    timings.struct_size = sizeof timings;
    timings.residual = 1e-5;
    gimdem_client_options_init(&options, sizeof options);
    options.endpoint = endpoint;
    options.name = "statuses";
    options.iterates = 1;
    EXPECT(gimdem_client_create(&options, &client) == GIMDEM_OK);
    EXPECT(gimdem_client_connect(client, &properties, &welcome) == GIMDEM_OK);
    EXPECT(welcome.schedule == GIMDEM_SCHEDULE_ITERATED && welcome.max_passes > 1 && welcome.tolerance > 0);
    EXPECT(welcome.fluid_steps == 1 && welcome.rank_endpoint_count == 0);
    EXPECT(gimdem_client_send_mesh(client, &mesh) == GIMDEM_OK);
    EXPECT_ERROR(gimdem_client_iterate_step(client, &fluid, 0.1, &solid), GIMDEM_ERROR_USER, "illegal");
    EXPECT(gimdem_client_begin_step(client, &step, &fluid, NULL, 0, &solid) == GIMDEM_OK);
    EXPECT(gimdem_client_iterate_step(client, &fluid, 0.1, &solid) == GIMDEM_OK);
    EXPECT(solid.cell_count == 1 && solid.drag_momentum[2] == 2.5);
    EXPECT(gimdem_client_end_step(client, &timings) == GIMDEM_OK);
    EXPECT(gimdem_client_finish(client, "done") == GIMDEM_OK);
    gimdem_client_destroy(client);
}

int main(int argc, char** argv)
{
    if (argc == 1)
    {
        check_absent();
        check_options();
        check_sizes();
    }
    else if (argc == 2)
        check_no_memory();
    else if (strcmp(argv[2], "iterated") == 0)
        check_iterated(argv[1]);
    else
    {
        gimdem_client* client = make_client(argv[1]);
        const gimdem_status status = session(client);
        EXPECT((int)status == atoi(argv[2]));
        if (status != GIMDEM_OK) printf("%s\n", gimdem_client_last_error());
        gimdem_client_destroy(client);
    }
    return failures == 0 ? 0 : 1;
}
