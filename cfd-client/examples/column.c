/* SPDX-License-Identifier: BSD-3-Clause */
/*
 * The solver of column.cpp in C99, coupled with client.h.
 *
 * Usage: column-c <endpoint> <run folder> [folder of keys] [--restart <state>]; the run folder has constant/column.
 * Writes column.csv (a line a step), profile.csv (a line a cell, at the end) and states/, from which it goes on, there.
 */
#define _POSIX_C_SOURCE 200809L /* fsync, mkdir */
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "gimdem/coupling/client.h"

#define GRAVITY (-9.81) /* along z [m/s^2] */
#define MOST_CELLS 1000

/* constant/column */
struct settings
{
    double width, depth, height, cells, density, viscosity, inflow, ramp_time, time_step, timeout, save_interval;
};

/* The gas. A vector field has three numbers a cell, of which only the last, along z, is not 0 here. */
struct column
{
    int n;
    double h, area, density; /* height of a cell, cross-section, density of the gas */
    double void_fraction[MOST_CELLS];
    double velocity[3 * MOST_CELLS];
    double velocity_gradient[9 * MOST_CELLS];
    double pressure_gradient[3 * MOST_CELLS];
    double void_fraction_gradient[3 * MOST_CELLS];
    double pressure[MOST_CELLS];
    double pressure_drop; /* from inlet to outlet [Pa] */
    double applied_force; /* of the particles on the gas, along z [N] */
    double outflow;       /* superficial velocity at the outlet [m/s] */
};

/* n cells above each other: level k has the points 4 k .. 4 k + 3, anticlockwise seen from above. */
struct mesh
{
    double points[12 * (MOST_CELLS + 1)];
    int32_t face_offsets[5 * MOST_CELLS + 2];
    int32_t face_points[4 * (5 * MOST_CELLS + 1)];
    int32_t owner[5 * MOST_CELLS + 1];
    int32_t neighbour[MOST_CELLS];
    int32_t face_count;
};

/* Too large for the stack. */
static struct column column;
static struct mesh mesh;

/* A name and a number a line; # begins a comment. */
static int read_settings(const char* folder, struct settings* settings)
{
    const struct
    {
        const char* name;
        double* value;
    } known[] = {{"width", &settings->width},         {"depth", &settings->depth},
                 {"height", &settings->height},       {"cells", &settings->cells},
                 {"density", &settings->density},     {"viscosity", &settings->viscosity},
                 {"inflow", &settings->inflow},       {"ramp_time", &settings->ramp_time},
                 {"time_step", &settings->time_step}, {"timeout", &settings->timeout},
                 {"save_interval", &settings->save_interval}};
    char line[1000], name[100];
    double value;
    size_t found = 0, i;
    FILE* file;
    snprintf(line, sizeof line, "%s/constant/column", folder);
    file = fopen(line, "r");
    if (file == NULL)
    {
        fprintf(stderr, "column-c: %s cannot be read\n", line);
        return 0;
    }
    while (fgets(line, sizeof line, file) != NULL)
        if (sscanf(line, "%99[a-z_] %lf", name, &value) == 2)
            for (i = 0; i < sizeof known / sizeof known[0]; ++i)
                if (strcmp(name, known[i].name) == 0)
                {
                    *known[i].value = value;
                    ++found;
                }
    fclose(file);
    if (found == sizeof known / sizeof known[0] && settings->cells >= 1 && settings->cells <= MOST_CELLS) return 1;
    fprintf(stderr, "column-c: constant/column lacks a setting, or has more than %d cells\n", MOST_CELLS);
    return 0;
}

static void add_face(int32_t owner, int32_t a, int32_t b, int32_t c, int32_t d)
{
    int32_t* points = mesh.face_points + 4 * mesh.face_count;
    points[0] = a;
    points[1] = b;
    points[2] = c;
    points[3] = d;
    mesh.owner[mesh.face_count++] = owner;
    mesh.face_offsets[mesh.face_count] = 4 * mesh.face_count;
}

static void make_mesh(int32_t n, const struct settings* settings)
{
    int32_t k, side;
    for (k = 0; k <= n; ++k)
        for (side = 0; side < 4; ++side)
        {
            double* point = mesh.points + 3 * (4 * k + side);
            point[0] = side == 1 || side == 2 ? settings->width : 0;
            point[1] = side >= 2 ? settings->depth : 0;
            point[2] = settings->height * k / n;
        }
    for (k = 1; k < n; ++k)
    {
        add_face(k - 1, 4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3);
        mesh.neighbour[k - 1] = k;
    }
    add_face(0, 0, 3, 2, 1);
    add_face(n - 1, 4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3);
    for (k = 0; k < n; ++k)
        for (side = 0; side < 4; ++side)
        {
            const int32_t next = (side + 1) % 4;
            add_face(k, 4 * k + side, 4 * k + next, 4 * (k + 1) + next, 4 * (k + 1) + side);
        }
}

static gimdem_status send_mesh(gimdem_client* client, int32_t n)
{
    const gimdem_patch patches[] = {{"inlet", GIMDEM_PATCH_OPEN, n - 1, 1, 0},
                                    {"outlet", GIMDEM_PATCH_OPEN, n, 1, 0},
                                    {"walls", GIMDEM_PATCH_WALL, n + 1, 4 * n, 0}};
    gimdem_mesh view = {0};
    view.struct_size = sizeof view;
    view.points = mesh.points;
    view.face_offsets = mesh.face_offsets;
    view.face_points = mesh.face_points;
    view.owner = mesh.owner;
    view.neighbour = mesh.neighbour;
    view.patches = patches;
    view.point_count = 4 * ((size_t)n + 1);
    view.face_count = (size_t)mesh.face_count;
    view.internal_face_count = (size_t)n - 1;
    view.patch_count = 3;
    view.cell_count = n;
    return gimdem_client_send_mesh(client, &view);
}

/* From the outlet, where the pressure is 0, downwards. */
static void integrate_pressure(void)
{
    double above = 0;
    int k;
    for (k = column.n - 1; k >= 0; --k)
    {
        const double rise = -column.pressure_gradient[3 * k + 2] * column.h;
        column.pressure[k] = above + 0.5 * rise;
        above += rise;
    }
    column.pressure_drop = above;
}

/* Gradients: from the cells on either side, one-sided at the ends. */
static void differentiate(void)
{
    int k;
    for (k = 0; k < column.n; ++k)
    {
        const int below = k == 0 ? k : k - 1;
        const int above = k + 1 == column.n ? k : k + 1;
        const double distance = column.h * (above - below);
        column.velocity_gradient[9 * k + 8] =
            (column.velocity[3 * above + 2] - column.velocity[3 * below + 2]) / distance;
        column.void_fraction_gradient[3 * k + 2] =
            (column.void_fraction[above] - column.void_fraction[below]) / distance;
    }
}

static FILE* open_table(const char* folder, const char* name)
{
    char file_name[1000];
    FILE* file;
    snprintf(file_name, sizeof file_name, "%s/%s", folder, name);
    file = fopen(file_name, "w");
    if (file == NULL) fprintf(stderr, "column-c: %s cannot be written\n", file_name);
    return file;
}

/* The gas at the end of the run, a line a cell. */
static int write_profile(const char* folder)
{
    FILE* file = open_table(folder, "profile.csv");
    int k;
    if (file == NULL) return 0;
    fprintf(file, "height,void_fraction,velocity,pressure\n");
    for (k = 0; k < column.n; ++k)
        fprintf(file, "%.17g,%.17g,%.17g,%.17g\n", column.h * (k + 0.5), column.void_fraction[k],
                column.velocity[3 * k + 2], column.pressure[k]);
    return fclose(file) == 0;
}

/* The gas at the end of a step in which that solid holds and gas comes in at that velocity. */
static void advance(const gimdem_solid_fields* solid, double inflow, double dt)
{
    double flux = inflow;
    int k;
    column.applied_force = 0;
    for (k = 0; k < column.n; ++k)
    {
        const double alpha = solid->void_fraction[k];
        const double flux_above = flux - column.h * (alpha - column.void_fraction[k]) / dt;
        const double v = 0.5 * (flux + flux_above) / alpha;
        const double source = solid->drag_momentum[3 * k + 2] - solid->drag_coefficient[k] * v;
        column.velocity[3 * k + 2] = v;
        column.pressure_gradient[3 * k + 2] = column.density * GRAVITY + source / alpha;
        column.applied_force += source * (column.area * column.h);
        column.void_fraction[k] = alpha;
        flux = flux_above;
    }
    column.outflow = flux;
    integrate_pressure();
    differentiate();
}

/* Where the gas goes on: a text that names the particles' checkpoint, then the resume point, then the column. The file
 * is there once it is whole and on disk. */
static int write_state(const char* folder, const gimdem_saved_checkpoint* saved, double time, long steps)
{
    char name[1000], part[1010];
    FILE* file;
    int k, good;
    snprintf(name, sizeof name, "%s/states", folder);
    mkdir(name, 0777); /* or it is there */
    snprintf(name, sizeof name, "%s/states/%09ld.state", folder, steps);
    snprintf(part, sizeof part, "%s.part", name);
    file = fopen(part, "w");
    if (file != NULL)
    {
        fprintf(file, "checkpoint %s\nsession %" PRIu64 "\nstep %" PRId64 "\ntime %.17g\nsteps %ld\napplied_force %.17g\n",
                saved->name, saved->session, saved->step, time, steps, column.applied_force);
        for (k = 0; k < column.n; ++k)
            fprintf(file, "%.17g %.17g %.17g\n", column.void_fraction[k], column.velocity[3 * k + 2],
                    column.pressure_gradient[3 * k + 2]);
        fprintf(file, "end\n");
        good = fflush(file) == 0 && !ferror(file) && fsync(fileno(file)) == 0;
        if (fclose(file) == 0 && good && rename(part, name) == 0) return 1;
    }
    fprintf(stderr, "column-c: %s cannot be written\n", name);
    return 0;
}

/* The resume point and the number of steps of the gas since the run began; the column goes on from there. */
static int read_state(const char* name, gimdem_resume_point* point, long* steps)
{
    FILE* file = fopen(name, "r");
    char end[4] = "";
    int k, good = 0;
    point->struct_size = sizeof *point;
    if (file != NULL)
    {
        good = fscanf(file, "checkpoint %*s session %" SCNu64 " step %" SCNd64 " time %lf steps %ld applied_force %lf",
                      &point->session, &point->step, &point->time, steps, &column.applied_force) == 5;
        for (k = 0; k < column.n && good; ++k)
            good = fscanf(file, "%lf %lf %lf", &column.void_fraction[k], &column.velocity[3 * k + 2],
                          &column.pressure_gradient[3 * k + 2]) == 3;
        good = good && fscanf(file, "%3s", end) == 1 && strcmp(end, "end") == 0;
        fclose(file);
    }
    if (!good) fprintf(stderr, "column-c: %s cannot be read, or is of another column\n", name);
    integrate_pressure();
    differentiate();
    return good;
}

/* column.csv; of a run that goes on in its folder, without the lines behind that time. */
static FILE* open_steps(const char* folder, double time)
{
    char name[1000], part[1000], line[1000];
    double t, last = -1;
    FILE* before;
    FILE* file = open_table(folder, "column.csv.part");
    snprintf(name, sizeof name, "%s/column.csv", folder);
    snprintf(part, sizeof part, "%s/column.csv.part", folder);
    if (file == NULL) return NULL;
    fprintf(file, "time,inflow,outflow,pressure_drop,applied_force\n");
    before = fopen(name, "r");
    while (before != NULL && fgets(line, sizeof line, before) != NULL)
        if (sscanf(line, "%lf", &t) == 1 && t > last && t <= time)
        {
            fputs(line, file);
            last = t;
        }
    if (before != NULL) fclose(before);
    if (rename(part, name) == 0) return file;
    fclose(file);
    return NULL;
}

static double inflow_at(double t, const struct settings* settings)
{
    return settings->inflow * fmin(1, t / settings->ramp_time);
}

/* One coupling step, of that number in the session; stops if the server asks for it. */
static gimdem_status do_step(gimdem_client* client, long number, long i, const struct settings* settings, FILE* table)
{
    const gimdem_monitor monitors[] = {{"applied_force_x", "N", 0},
                                       {"applied_force_y", "N", 0},
                                       {"applied_force_z", "N", column.applied_force}};
    const double dt = settings->time_step;
    const double t = dt * (double)i;
    gimdem_step step = {sizeof step, 0, 0, 0};
    gimdem_fluid_fields fluid = {0};
    gimdem_solid_fields solid = {0};
    gimdem_status status;
    step.number = number;
    step.time = dt * (double)(i - 1);
    step.dt = dt;
    fluid.struct_size = sizeof fluid;
    fluid.cell_count = (size_t)column.n;
    fluid.velocity = column.velocity;
    fluid.velocity_gradient = column.velocity_gradient;
    fluid.pressure_gradient = column.pressure_gradient;
    fluid.void_fraction_gradient = column.void_fraction_gradient;
    fluid.pressure = column.pressure;
    solid.struct_size = sizeof solid;
    status = gimdem_client_begin_step(client, &step, &fluid, monitors, sizeof monitors / sizeof monitors[0], &solid);
    if (status != GIMDEM_OK) return status;
    advance(&solid, inflow_at(t, settings), dt);
    fprintf(table, "%.17g,%.17g,%.17g,%.17g,%.17g\n", t, inflow_at(t, settings), column.outflow, column.pressure_drop,
            column.applied_force);
    return gimdem_client_end_step(client, NULL);
}

/* Both states of now; *complete is the newest checkpoint of which we have a state. */
static gimdem_status save(gimdem_client* client, const char* folder, double time, long steps, int64_t* complete)
{
    gimdem_saved_checkpoint saved = {sizeof saved, 0, 0, 0, NULL};
    const gimdem_status status = gimdem_client_save_checkpoint(client, time, *complete, &saved);
    if (status != GIMDEM_OK) return status;
    *complete = saved.step;
    if (write_state(folder, &saved, time, steps)) return GIMDEM_OK;
    gimdem_client_abort(client, "the state of the gas cannot be written");
    return GIMDEM_ERROR_INTERNAL;
}

/* All steps behind `begin`, and the end in order. */
static gimdem_status do_steps(gimdem_client* client, const gimdem_welcome* welcome, const struct settings* settings,
                              const char* folder, const gimdem_resume_point* point, long begin, FILE* table)
{
    const long steps = lround(welcome->end_time / settings->time_step);
    const long interval = lround(settings->save_interval / settings->time_step);
    const long steps_per_state = interval > 1 ? interval : 1;
    const char* asked_to_stop = NULL;
    gimdem_status status = GIMDEM_OK;
    int64_t complete = point->step;
    long i;
    for (i = begin + 1; i <= steps && asked_to_stop == NULL && status == GIMDEM_OK; ++i)
    {
        status = do_step(client, i - begin, i, settings, table);
        if (status == GIMDEM_OK) status = gimdem_client_stop_request(client, &asked_to_stop);
        if (status != GIMDEM_OK || !welcome->saves_checkpoints) continue;
        if (i % steps_per_state != 0 && i != steps && asked_to_stop == NULL) continue;
        fflush(table);
        status = save(client, folder, settings->time_step * (double)i, i, &complete);
    }
    if (status != GIMDEM_OK) return status;
    return gimdem_client_finish(client, asked_to_stop != NULL ? "stopped as asked" : "end time reached");
}

/* The whole session, from step `begin` on; the first call that fails ends it. */
static gimdem_status run(gimdem_client* client, const struct settings* settings, const char* folder,
                         const gimdem_resume_point* point, long begin, FILE* table)
{
    gimdem_fluid_properties fluid = {sizeof fluid, 0, 0};
    gimdem_welcome welcome = {0};
    gimdem_solid_fields solid = {0};
    gimdem_status status;
    int k;
    fluid.density = settings->density;
    fluid.viscosity = settings->viscosity;
    welcome.struct_size = sizeof welcome;
    solid.struct_size = sizeof solid;
    if ((status = gimdem_client_connect(client, &fluid, &welcome)) != GIMDEM_OK) return status;
    if ((status = send_mesh(client, (int32_t)column.n)) != GIMDEM_OK) return status;
    if ((status = gimdem_client_solid(client, &solid)) != GIMDEM_OK) return status;
    for (k = 0; k < column.n && begin == 0; ++k)
        column.void_fraction[k] = solid.void_fraction[k];
    if (begin == 0) advance(&solid, inflow_at(0, settings), settings->time_step);
    return do_steps(client, &welcome, settings, folder, point, begin, table);
}

/* resume: NULL where a run begins. */
static gimdem_status create(const char* endpoint, double timeout, char const* keys, gimdem_resume_point const* resume,
                            gimdem_client** client)
{
    gimdem_client_options options;
    const gimdem_status status = gimdem_client_options_init(&options, sizeof options);
    *client = NULL;
    if (status != GIMDEM_OK) return status;
    options.endpoint = endpoint;
    options.name = "column-c";
    options.timeout = timeout;
    options.keys = keys;
    options.resume = resume;
    return gimdem_client_create(&options, client);
}

int main(int argc, char** argv)
{
    struct settings settings = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    gimdem_resume_point point = {sizeof point, 0, 0, 0};
    const char* restart = NULL;
    long begin = 0;
    gimdem_client* client;
    gimdem_status status;
    FILE* table;
    if (argc > 4 && strcmp(argv[argc - 2], "--restart") == 0)
    {
        restart = argv[argc - 1];
        argc -= 2;
    }
    if (argc != 3 && argc != 4)
    {
        fprintf(stderr, "usage: column-c <endpoint> <run folder> [folder of keys] [--restart <state>]\n");
        return 2;
    }
    if (!read_settings(argv[2], &settings)) return 1;
    column.n = (int)settings.cells;
    column.h = settings.height / column.n;
    column.area = settings.width * settings.depth;
    column.density = settings.density;
    make_mesh((int32_t)column.n, &settings);
    if (restart != NULL && !read_state(restart, &point, &begin)) return 1;
    table = open_steps(argv[2], point.time);
    if (table == NULL) return 1;

    status = create(argv[1], settings.timeout, argc == 4 ? argv[3] : NULL, restart != NULL ? &point : NULL, &client);
    if (status == GIMDEM_OK) status = run(client, &settings, argv[2], &point, begin, table);
    if (status != GIMDEM_OK && gimdem_client_last_error()[0] != 0)
        fprintf(stderr, "column-c: %s\n", gimdem_client_last_error());
    gimdem_client_destroy(client);
    fclose(table);
    return status == GIMDEM_OK && write_profile(argv[2]) ? 0 : 1;
}
