/* SPDX-License-Identifier: BSD-3-Clause */
/*
 * The CFD side of a coupled run in C99: what Client.hpp is, for a program or a user routine that is not C++.
 * Link one library, libgimdem_client.so (pkg-config: gimdem-client); no C++ type or exception crosses its border.
 *
 *     gimdem_client_options options;
 *     gimdem_client_options_init(&options, sizeof options);
 *     options.endpoint = endpoint;
 *     options.name = "mySolver";
 *     gimdem_client_create(&options, &client);
 *     gimdem_client_connect(client, &fluid, &welcome);       Hello -> Welcome
 *     gimdem_client_send_mesh(client, &mesh);                Mesh -> MeshAccepted, then the solid at t = 0
 *     while (...)                                            both schedules, same loop
 *     {
 *         gimdem_client_begin_step(client, &step, &fields, monitors, monitor_count, &solid);
 *         ... solve the fluid t -> t + dt with solid ...
 *         gimdem_client_end_step(client, NULL);
 *     }
 *     gimdem_client_finish(client, "end time reached");      Goodbye
 *     gimdem_client_destroy(client);
 *
 * gimdem_client_save_checkpoint() between two steps, and options.resume in another run: to go on after a stop, see
 * docs/write-a-client.md, 5.
 *
 * Every function that returns a gimdem_status returns GIMDEM_OK or why it failed; gimdem_client_last_error() then has
 * the words. One client belongs to one thread at a time. SI units; arrays are flat and row-major; nothing that is
 * passed in is kept beyond the call.
 *
 * Structs begin with their size, which `struct_size` must hold: the library never reads or writes beyond it. Later
 * versions add members at the end, so a program goes on working with a newer library, compiled as it is. For structs
 * that the program fills, a member that the program does not know is 0, which means its default. A program with a
 * newer header than the library may fill new members with 0 only, or is refused (GIMDEM_ERROR_USER).
 */
#ifndef GIMDEM_COUPLING_CLIENT_H
#define GIMDEM_COUPLING_CLIENT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C"
{
#endif

#if defined(__GNUC__)
#define GIMDEM_CLIENT_API __attribute__((visibility("default")))
#else
#define GIMDEM_CLIENT_API
#endif

    /* Why a call failed; Error.hpp has the same list. A negative number is no fault of the session. */
    typedef enum gimdem_status
    {
        GIMDEM_OK = 0,
        GIMDEM_ERROR_USER =
            1, /* wrong options, an illegal call, a field with NaN: nothing was sent, the session lives */
        GIMDEM_ERROR_VERSION = 2,  /* the server speaks another protocol */
        GIMDEM_ERROR_PROTOCOL = 3, /* the server sent something malformed or out of order */
        GIMDEM_ERROR_MESH = 4,     /* the server refused the mesh */
        GIMDEM_ERROR_TIMEOUT = 5,  /* the server was silent, or did not answer in time */
        GIMDEM_ERROR_PEER = 6,     /* the server reported an error or disappeared */
        GIMDEM_ERROR_ENDPOINT = 7, /* the address cannot be reached or is not allowed */
        GIMDEM_ERROR_INTERNAL = -1 /* no memory, or a mistake of this library */
    } gimdem_status;

    /* Which time level each solver sees within one coupling step, docs/theory.md section C. */
    enum
    {
        GIMDEM_SCHEDULE_OF_SERVER = 0, /* as the server's case file says */
        GIMDEM_SCHEDULE_SERIAL = 1,
        GIMDEM_SCHEDULE_OVERLAPPED = 2,
        GIMDEM_SCHEDULE_ITERATED = 3 /* as serial, and gimdem_client_iterate_step() repeats the step */
    };

    /* What a boundary patch of the mesh is to the particles. */
    enum
    {
        GIMDEM_PATCH_WALL = 1,
        GIMDEM_PATCH_OPEN = 2,
        GIMDEM_PATCH_SYMMETRY = 3,
        GIMDEM_PATCH_EMPTY = 4,
        GIMDEM_PATCH_CYCLIC = 5,
        GIMDEM_PATCH_PROCESSOR = 6
    };

    typedef struct gimdem_client gimdem_client;

    /* Where a client goes on that stopped before; from gimdem_saved_checkpoint. */
    typedef struct gimdem_resume_point
    {
        size_t struct_size;
        uint64_t session;
        int64_t step;
        double time; /* of the fluid [s] */
    } gimdem_resume_point;

    /* Fill it with gimdem_client_options_init(), then set what should differ. */
    typedef struct gimdem_client_options
    {
        size_t struct_size;
        char const* endpoint;     /* "ipc:///path/socket" or "tcp://127.0.0.1:port" */
        char const* name;         /* who we are, for messages and logs */
        double timeout;           /* a server silent for this long is dead, 0: 30 [s] */
        double connect_time;      /* how long connect waits for a server to appear, 0: 60 [s] */
        double step_time;         /* longest wait for the answer of a live server, 0: 3600 [s] */
        char const* const* wants; /* names of solid fields; NULL: void_fraction, drag_coefficient, drag_momentum */
        size_t want_count;
        char const* keys;                  /* folder of keys, docs/security.md; NULL: none, and this machine only */
        gimdem_resume_point const* resume; /* where to go on; NULL: a run begins */
        uint64_t run;             /* where rank_count > 1: a random number, not 0, that rank 0 tells the others */
        int32_t schedule;         /* GIMDEM_SCHEDULE_... */
        int32_t no_shared_memory; /* 1: plain frames over ipc too */
        int32_t iterates;         /* 1: the program calls iterate_step if the schedule is iterated */
        int32_t rank;             /* of this process among those that solve the fluid together (MPI) */
        int32_t rank_count;       /* 0, 1: this process alone */
        int32_t reserved;
    } gimdem_client_options;

    /* Constant properties of the fluid. */
    typedef struct gimdem_fluid_properties
    {
        size_t struct_size;
        double density;   /* [kg/m^3] */
        double viscosity; /* dynamic [Pa s] */
    } gimdem_fluid_properties;

    /* The server's answer; the texts live as long as the client. */
    typedef struct gimdem_welcome
    {
        size_t struct_size;
        char const* server;       /* name and version of the server */
        char const* title;        /* of the case */
        double end_time;          /* the run ends here [s] */
        char const* const* needs; /* fluid fields that this scene needs */
        size_t need_count;
        char const* const* rank_endpoints; /* to rank 0 of several: where ranks 1, 2, ... connect */
        size_t rank_endpoint_count;
        double tolerance;          /* schedule iterated: relative residual at which a step is accepted */
        double relaxation;         /* schedule iterated: factor of the first pass */
        int32_t max_passes;        /* schedule iterated: of a step */
        int32_t must_converge;     /* schedule iterated: 0: a step that did not is accepted as it is */
        int32_t schedule;          /* in force */
        int32_t fluid_steps;       /* equal fluid steps that a coupling step should have */
        int32_t saves_checkpoints; /* 1: gimdem_client_save_checkpoint() is possible */
        int32_t reserved;
    } gimdem_welcome;

    /* One boundary patch: a run of boundary faces. */
    typedef struct gimdem_patch
    {
        char const* name;
        int32_t kind;       /* GIMDEM_PATCH_... */
        int32_t start_face; /* first face, not less than internal_face_count */
        int32_t face_count;
        int32_t neighbour_rank; /* of a processor patch: the rank that has the cells behind it */
    } gimdem_patch;

    /* A polyhedral mesh in OpenFOAM's addressing: internal faces first, the normal of a face leaves its owner. */
    typedef struct gimdem_mesh
    {
        size_t struct_size;
        double const* points; /* (point_count, 3) [m] */
        int32_t const*
            face_offsets; /* (face_count + 1,): face f has face_points[face_offsets[f] .. face_offsets[f + 1]) */
        int32_t const* face_points;  /* (face_offsets[face_count],) */
        int32_t const* owner;        /* (face_count,) */
        int32_t const* neighbour;    /* (internal_face_count,) */
        gimdem_patch const* patches; /* (patch_count,) */
        size_t point_count;
        size_t face_count;
        size_t internal_face_count;
        size_t patch_count;
        int32_t cell_count;
        int32_t reserved;
    } gimdem_mesh;

    /* One coupling step, t -> t + dt. */
    typedef struct gimdem_step
    {
        size_t struct_size;
        int64_t number; /* 1, 2, ... */
        double time;    /* t, where the step begins [s] */
        double dt;      /* [s] */
    } gimdem_step;

    /* The fluid at t. What the scene does not need may be NULL. Component [3 * i + j] of a gradient is d(v_j)/d(x_i).
     */
    typedef struct gimdem_fluid_fields
    {
        size_t struct_size;
        size_t cell_count;                    /* of each array; that of the mesh */
        double const* velocity;               /* (cell_count, 3) [m/s] */
        double const* velocity_gradient;      /* (cell_count, 9) [1/s] */
        double const* pressure_gradient;      /* (cell_count, 3) [Pa/m] */
        double const* void_fraction_gradient; /* (cell_count, 3) [1/m] */
        double const* pressure;               /* (cell_count,) [Pa] */
    } gimdem_fluid_fields;

    /* The solid; what was not wanted is NULL. Force per volume on fluid of velocity v: drag_momentum - drag_coefficient
     * * v, theory.md (C.5) to (C.7). The arrays live until the next begin_step or end_step. */
    typedef struct gimdem_solid_fields
    {
        size_t struct_size;
        size_t cell_count;
        double const* void_fraction;    /* (cell_count,) [1], in (0, 1] */
        double const* momentum_source;  /* (cell_count, 3) [N/m^3] */
        double const* drag_coefficient; /* (cell_count,) [kg/(m^3 s)] */
        double const* drag_momentum;    /* (cell_count, 3) [N/m^3] */
    } gimdem_solid_fields;

    /* A named number about the last step, for logs: {"courant_max", "1", 0.4}. */
    typedef struct gimdem_monitor
    {
        char const* name;
        char const* unit;
        double value;
    } gimdem_monitor;

    /* What the server has saved. */
    typedef struct gimdem_saved_checkpoint
    {
        size_t struct_size;
        uint64_t session;
        int64_t step;
        double time;      /* of the particles [s] */
        char const* name; /* of the file, without its folder; lives until the next checkpoint */
    } gimdem_saved_checkpoint;

    /* Where the fluid step spent its wall time, and how well an iterated one converged. */
    typedef struct gimdem_timings
    {
        size_t struct_size;
        double compute;  /* [s] */
        double output;   /* [s] */
        double residual; /* schedule iterated: relative, of the last pass */
    } gimdem_timings;

    /* What the client measured of the coupling, summed over the run. */
    typedef struct gimdem_exchange_times
    {
        size_t struct_size;
        double exchange; /* packing, sending, receiving [s] */
        double waiting;  /* blocked while the server computes [s] */
        double bytes;    /* sent and received */
    } gimdem_exchange_times;

    /* Protocol that this library speaks; docs/protocol.md. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_protocol(int32_t* major, int32_t* minor);

    /* What the last failed call of this thread found, why it is a problem and what to do; "" before any has failed. It
     * lives until the next failure in this thread. */
    GIMDEM_CLIENT_API char const* gimdem_client_last_error(void);

    /* Defaults; size is sizeof(gimdem_client_options). */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_options_init(gimdem_client_options* options, size_t size);

    /* A client that is not connected yet. On a failure *client is NULL. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_create(gimdem_client_options const* options, gimdem_client** client);

    /* Hello -> Welcome. welcome may be NULL. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_connect(gimdem_client* client, gimdem_fluid_properties const* fluid,
                                                          gimdem_welcome* welcome);

    /* Mesh -> MeshAccepted and the solid at t = 0. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_send_mesh(gimdem_client* client, gimdem_mesh const* mesh);

    /* Sends the fluid at t; *solid is what the fluid step must use. monitors may be NULL if monitor_count is 0. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_begin_step(gimdem_client* client, gimdem_step const* step,
                                                             gimdem_fluid_fields const* fluid,
                                                             gimdem_monitor const* monitors, size_t monitor_count,
                                                             gimdem_solid_fields* solid);

    /* Schedule iterated: the server goes back to the beginning of the step and repeats it in this estimate of the
     * fluid at its end; *solid is what the fluid step, from its own state at t, must use. residual: relative, of the
     * pass before. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_iterate_step(gimdem_client* client,
                                                               gimdem_fluid_fields const* estimate, double residual,
                                                               gimdem_solid_fields* solid);

    /* After the fluid step. timings may be NULL. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_end_step(gimdem_client* client, gimdem_timings const* timings);

    /* Between two steps, where the server saves checkpoints: has it save its state of now; returns when that is safe on
     * disk. The fluid's state of now belongs to it: write it, then remember *saved, for gimdem_client_options.resume.
     * time: where the last step ended. complete_step: step of the newest checkpoint to which a fluid is whole, 0: none.
     */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_save_checkpoint(gimdem_client* client, double time,
                                                                  int64_t complete_step,
                                                                  gimdem_saved_checkpoint* saved);

    /* The last solid received. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_solid(gimdem_client* client, gimdem_solid_fields* solid);

    /* *reason: why the server asks for an orderly end, NULL if it does not. Then write your fields and call finish. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_stop_request(gimdem_client* client, char const** reason);

    GIMDEM_CLIENT_API gimdem_status gimdem_client_exchange_times(gimdem_client* client, gimdem_exchange_times* times);

    /* Orderly end: Goodbye. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_finish(gimdem_client* client, char const* reason);

    /* Tell the server why we stop, before destroy. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_abort(gimdem_client* client, char const* reason);

    /* Frees the client; an unfinished session is aborted. NULL is nothing to free. */
    GIMDEM_CLIENT_API gimdem_status gimdem_client_destroy(gimdem_client* client);

#ifdef __cplusplus
}
#endif

#endif
