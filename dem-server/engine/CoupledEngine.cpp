// SPDX-License-Identifier: BSD-3-Clause
#include "engine/CoupledEngine.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "core/Error.hpp"
#include "engine/InletFlow.hpp"
#include "engine/StepMemory.hpp"
#include "exec/Reduce.hpp"

namespace gimdem
{

namespace
{

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Sum of value(i), a Vec3, in fixed order.
template <class Value>
Vec3 vector_sum(exec::Execution execution, std::int64_t count, Value value)
{
    Constant3 const total = exec::reduce(
        execution, count, Constant3{0, 0, 0},
        [=](std::int64_t i)
        {
            Vec3 const v = value(i);
            return Constant3{v.x(), v.y(), v.z()};
        },
        [](Constant3 a, Constant3 b) {
            return Constant3{a.x + b.x, a.y + b.y, a.z + b.z};
        });
    return total.vec();
}

void refuse_reuse_on_devices(MappingSettings const& mapping)
{
    if (mapping.reuse_distance == 0) return;
    throw UserError(
        "[mapping] reuse_distance does not work on a GPU (it keeps no weights: it computes one faster than it reads "
        "one); leave it out, or run on the processor with --device cpu");
}

}  // namespace

CoupledEngine::CoupledEngine(Case const& settings, exec::Execution execution, PolyMesh const& mesh,
                             WallGeometry const& walls, coupling::FluidProperties const& fluid, DemSystem& system)
    : settings_(settings),
      execution_(execution),
      mesh_(mesh),
      mesh_hash_(mesh_hash(mesh.topology())),
      system_(system),
      forces_(execution, settings.fluid_forces, settings.mapping.void_fraction_minimum, fluid),
      mapper_(execution, mesh, settings.mapping),
      on_particles_{forces_, mesh, mapper_.cell_of(), void_fraction_},
      coverage_(mesh)
{
    wall_faces_.resize(mesh.face_count());
    for (std::int32_t f = 0; f < mesh.face_count(); ++f)
        wall_faces_[f] = walls.is_wall_face(f);
    system_.set_permutation_listener([this](std::span<std::int32_t const> order) { mapper_.permute(order); });
    if (DeviceDem* const device = system_.device())
    {
        refuse_reuse_on_devices(settings.mapping);
        device->set_fluid({settings, fluid, mesh, mapper_, wall_faces_}, std::as_const(system_).particles());
    }
}

void CoupledEngine::load_fluid(coupling::FluidFields const& fluid)
{
    if (DeviceDem* const device = system_.device())
        device->load_fluid(fluid);
    else
        forces_.load(fluid, mesh_.cell_count());
}

// Where some have left, the host's mapper finds out through which faces.
void CoupledEngine::locate()
{
    DeviceDem* const device = system_.device();
    if (device == nullptr) return mapper_.locate(std::as_const(system_).particles(), wall_faces_);
    exec::Buffer<std::int32_t> cells;
    bool const all_are_inside = device->locate();
    if (!all_are_inside) device->download_cells(cells);
    mapper_.take_cells(std::move(cells));
    if (!all_are_inside) mapper_.locate(std::as_const(system_).particles(), wall_faces_);
}

void CoupledEngine::sum_into_cells()
{
    if (DeviceDem* const device = system_.device()) return device->sum_into_cells(sums_);
    mapper_.compute_weights(system_.particles());
    mapper_.sum_into_cells(system_.particles(), system_.impulses(), sums_);
}

std::int64_t CoupledEngine::particle_clips() const
{
    DeviceDem* const device = system_.device();
    return (device == nullptr ? forces_.clipped() : device->clipped()) - clips_given_up_;
}

StepReport CoupledEngine::map_initial_state()
{
    StepReport report;
    std::vector<double> const still(static_cast<std::size_t>(mesh_.cell_count()) * 3, 0.0);
    coupling::FluidFields fluid;
    fluid.velocity = still;
    load_fluid(fluid);
    locate();
    if (!mapper_.left().empty()) Mapper::refuse_outside(system_.particles(), mapper_.left().front().particle);
    sum_into_cells();
    compute_void_fraction(report);

    // The drag as it is now, as if it had acted for a second.
    system_.begin_coupling_step(&on_particles_);
    system_.take_impulses_of_one_second();
    map_particles(
        1, [&] { return fluid; }, report);
    look_ahead();
    return report;
}

StepReport CoupledEngine::advance(coupling::Step const& step, coupling::FluidFields fluid,
                                  std::function<coupling::FluidFields()> const& whole_fluid)
{
    StepReport report;
    auto const start = std::chrono::steady_clock::now();
    report.dem_steps = std::max<std::int64_t>(1, std::llround(std::ceil(step.dt / settings_.dem.time_step - 1e-9)));
    auto const fetch = [&]
    {
        report.fluid_was_wanted = true;
        fluid = whole_fluid();
    };
    bool const is_whole = !whole_fluid;
    insert_due(step.time);
    if (!is_whole && !coverage_.has_loads(cells_with_particles())) fetch();
    load_fluid(fluid);
    system_.begin_coupling_step(&on_particles_);
    system_.let_walls_move(true);
    report.pressure_force = constant3(system_.steady_fluid_force());
    for (std::int64_t k = 0; k < report.dem_steps; ++k)
        system_.step(step.dt / static_cast<double>(report.dem_steps));
    report.timings.compute = seconds_since(start);

    auto const mapping_start = std::chrono::steady_clock::now();
    auto const fluid_at_drag = [&]
    {
        if (!is_whole && !report.fluid_was_wanted && !coverage_.has_velocity(has_drag_.host())) fetch();
        return fluid;
    };
    map_particles(step.dt, fluid_at_drag, report);
    report.removed = remove_leavers();
    look_ahead();
    report.timings.mapping = seconds_since(mapping_start);
    return report;
}

void CoupledEngine::insert_due(double time)
{
    if (inlets_ == nullptr || insert_from(*inlets_, time, system_) == 0) return;
    locate();
    if (!mapper_.left().empty()) Mapper::refuse_outside(system_.particles(), mapper_.left().front().particle);
}

// What they received in their last step is on the mesh by now, so that nothing of the balance is lost, theory.md
// (D.67).
std::int64_t CoupledEngine::remove_leavers()
{
    if (mapper_.left().empty()) return 0;
    auto const& patches = mesh_.topology().patches;
    std::vector<std::string> causes;
    for (coupling::Patch const& patch : patches)
        causes.push_back("through " + patch.name);
    std::vector<std::int32_t> cause(static_cast<std::size_t>(system_.particles().count()), -1);
    for (Mapper::Leaver const& leaver : mapper_.left())
        for (std::size_t k = 0; k < patches.size(); ++k)
        {
            if (leaver.face < patches[k].start_face || leaver.face >= patches[k].start_face + patches[k].face_count)
                continue;
            if (patches[k].kind != coupling::PatchKind::open)
                Mapper::refuse_outside(system_.particles(), leaver.particle);
            cause[static_cast<std::size_t>(leaver.particle)] = static_cast<std::int32_t>(k);
        }
    return system_.remove(cause, causes);
}

coupling::SolidFields CoupledEngine::fields() const
{
    coupling::SolidFields fields;
    auto const span = [](exec::Buffer<double> const& b)
    { return coupling::Span<double const>(b.view().data, static_cast<std::size_t>(b.size())); };
    fields.void_fraction = span(void_fraction_);
    fields.momentum_source = span(momentum_source_);
    fields.drag_coefficient = span(drag_coefficient_);
    fields.drag_momentum = span(drag_momentum_);
    return fields;
}

void CoupledEngine::map_particles(double dt, std::function<coupling::FluidFields()> const& fluid, StepReport& report)
{
    locate();
    sum_into_cells();
    compute_void_fraction(report);
    mark_cells();
    compute_momentum_exchange(dt, fluid());
    check_balance(dt, report);
}

void CoupledEngine::compute_void_fraction(StepReport& report)
{
    void_fraction_.resize(mesh_.cell_count());
    report.cell_clips = 0;
    report.void_fraction_min = 1;
    report.void_fraction_max = 0;
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
    {
        double const exact = 1 - sums_.solid_volume[c] / mesh_.volume(c);
        void_fraction_[c] = std::max(exact, settings_.mapping.void_fraction_minimum);
        report.cell_clips += void_fraction_[c] != exact;
        report.void_fraction_min = std::min(report.void_fraction_min, void_fraction_[c]);
        report.void_fraction_max = std::max(report.void_fraction_max, void_fraction_[c]);
    }
    if (DeviceDem* const device = system_.device()) device->set_void_fraction(void_fraction_);
}

void CoupledEngine::mark_cells()
{
    has_solid_.resize(mesh_.cell_count());
    has_drag_.resize(mesh_.cell_count());
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
    {
        Quad const drag = sums_.drag[c];
        has_drag_[c] = drag.w != 0;
        has_solid_[c] = has_drag_[c] != 0 || void_fraction_[c] != 1 || drag.x != 0 || drag.y != 0 || drag.z != 0;
    }
}

void CoupledEngine::look_ahead()
{
    coverage_.look_ahead(cells_with_particles(), has_drag_.host());
}

// A device keeps the places of its particles to itself, and tells flags of the cells.
std::span<std::int32_t const> CoupledEngine::cells_with_particles()
{
    DeviceDem* const device = system_.device();
    if (device == nullptr) return mapper_.cell_of().host();
    device->occupied_cells(occupied_);
    occupied_cells_.clear();
    for (std::int32_t c = 0; c < mesh_.cell_count(); ++c)
        if (occupied_[c] != 0) occupied_cells_.push_back(c);
    return occupied_cells_;
}

coupling::StepCells CoupledEngine::step_cells(bool can_ask)
{
    coupling::StepCells cells;
    std::span<std::uint8_t const> const flags = has_solid_.host();
    cells.solid = coupling::runs_where({flags.data(), flags.size()});
    bool const may_come_anywhere = inlets_ != nullptr && !inlets_->empty() && !can_ask;
    if (!may_come_anywhere) cells.needed = coverage_.needed(!can_ask);
    return cells;
}

// S = -(1/V) sum w F_d, K = (1/V) sum w k, and K u_p = S + K v with the fluid velocity v of the cell that the drag was
// computed with, theory.md (C.2), (C.5)-(C.7).
void CoupledEngine::compute_momentum_exchange(double dt, coupling::FluidFields const& fluid)
{
    std::int64_t const n = mesh_.cell_count();
    momentum_source_.resize(3 * n);
    drag_coefficient_.resize(n);
    drag_momentum_.resize(3 * n);
    double const* const velocity = fluid.velocity.data();
    for (std::int64_t c = 0; c < n; ++c)
    {
        double const per_volume = 1 / (dt * mesh_.volume(static_cast<std::int32_t>(c)));
        double const k = sums_.drag[c].w * per_volume;
        // +0 where nothing is, and there no velocity is read.
        Vec3 const source = has_solid_[c] != 0 ? Vec3(-per_volume * sums_.drag[c].xyz()) : Vec3::Zero();
        bool const has_drag = has_drag_[c] != 0 && velocity != nullptr;
        drag_coefficient_[c] = k;
        for (int axis = 0; axis < 3; ++axis)
        {
            momentum_source_[3 * c + axis] = source[axis];
            drag_momentum_[3 * c + axis] = source[axis] + (has_drag ? k * velocity[3 * c + axis] : 0);
        }
    }
}

ImpulseSums CoupledEngine::impulse_sums() const
{
    if (DeviceDem* const device = system_.device()) return device->impulse_sums();
    Impulse const* const impulse = system_.impulses().view().data;
    Quad const* const x = std::as_const(system_).particles().position.view().data;
    return exec::reduce(
        execution_, system_.impulses().size(), ImpulseSums{},
        [=](std::int64_t p) {
            return ImpulseSums{impulse[p].drag, impulse[p].drag.xyz().norm(), sphere_volume(x[p].w)};
        },
        [](ImpulseSums const& a, ImpulseSums const& b) { return a + b; });
}

void CoupledEngine::check_balance(double dt, StepReport& report) const
{
    ImpulseSums const sums = impulse_sums();
    Vec3 const drag = sums.drag.xyz() / dt;
    double const magnitude = sums.magnitude / dt;

    double const* const s = momentum_source_.view().data;
    Quad const* const cell = mesh_.view().cell;
    double const* const solid_volume = sums_.solid_volume.view().data;
    Vec3 const given =
        vector_sum(execution_, mesh_.cell_count(),
                   [=](std::int64_t c) { return Vec3(cell[c].w * Vec3(s[3 * c], s[3 * c + 1], s[3 * c + 2])); });
    double const mapped = exec::sum(execution_, mesh_.cell_count(), [=](std::int64_t c) { return solid_volume[c]; });

    report.drag_force = constant3(drag);
    report.wall_force = constant3(system_.wall_impulse() / dt);
    report.momentum_imbalance = magnitude > 0 ? (given + drag).norm() / magnitude : 0;
    report.volume_imbalance = sums.volume > 0 ? std::abs(mapped - sums.volume) / sums.volume : 0;
}

}  // namespace gimdem
