// SPDX-License-Identifier: BSD-3-Clause
/// What of a coupled engine goes into a checkpoint, and comes out of it.
#include <algorithm>
#include <utility>

#include "core/Error.hpp"
#include "engine/CoupledEngine.hpp"

namespace gimdem
{

namespace
{

template <class T>
std::vector<T> to_vector(exec::Buffer<T> const& buffer)
{
    return {buffer.host().begin(), buffer.host().end()};
}

template <class T>
exec::Buffer<T> to_buffer(std::vector<T> const& values)
{
    exec::Buffer<T> buffer(std::ssize(values));
    std::copy(values.begin(), values.end(), buffer.host().begin());
    return buffer;
}

}  // namespace

MappedState CoupledEngine::mapped() const
{
    return {.mesh = mesh_hash_,
            .cell_of = to_vector(mapper_.cell_of()),
            .void_fraction = to_vector(void_fraction_),
            .drag_coefficient = to_vector(drag_coefficient_),
            .momentum_source = to_vector(momentum_source_),
            .drag_momentum = to_vector(drag_momentum_)};
}

void CoupledEngine::forget_particles()
{
    mapper_.take_cells({});
    if (WeightReuse* const reuse = mapper_.reuse()) reuse->restore({});
}

// On a device, cells are found anew: they differ where a particle is on the very border of two.
void CoupledEngine::resume(MappedState const& mapped)
{
    if (mapped.mesh != mesh_hash_)
    {
        map_initial_state();
        return;
    }
    if (!mapped.fits(std::as_const(system_).particles().count(), mesh_.cell_count()))
        throw UserError(
            "the checkpoint's fields do not fit its particles (it is damaged, or another program wrote it); restart "
            "from another one");
    DeviceDem* const device = system_.device();
    if (device != nullptr)
        locate();
    else
        mapper_.take_cells(to_buffer(mapped.cell_of));
    void_fraction_ = to_buffer(mapped.void_fraction);
    drag_coefficient_ = to_buffer(mapped.drag_coefficient);
    momentum_source_ = to_buffer(mapped.momentum_source);
    drag_momentum_ = to_buffer(mapped.drag_momentum);
    if (device != nullptr) device->set_void_fraction(void_fraction_);
    mark_resumed_cells();
    look_ahead();
}

void CoupledEngine::mark_resumed_cells()
{
    has_solid_.resize(mesh_.cell_count());
    has_drag_.resize(mesh_.cell_count());
    for (std::int64_t c = 0; c < mesh_.cell_count(); ++c)
    {
        has_drag_[c] = drag_coefficient_[c] != 0;
        has_solid_[c] = has_drag_[c] != 0 || void_fraction_[c] != 1;
        for (std::int64_t k = 3 * c; k < 3 * c + 3; ++k)
            has_solid_[c] |= momentum_source_[k] != 0 || drag_momentum_[k] != 0;
    }
}

}  // namespace gimdem
