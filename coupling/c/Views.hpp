// SPDX-License-Identifier: BSD-3-Clause
/// From the plain structs of client.h to the types of Client.hpp, and back.
#pragma once

#include <string>
#include <vector>

#include "gimdem/coupling/Client.hpp"
#include "gimdem/coupling/client.h"

namespace gimdem::coupling::c
{

ClientOptions options_of(gimdem_client_options const& given);

/// Every array at the length that its count tells; what the counts say of the arrays' contents is checked by Client.
MeshView view_of(gimdem_mesh const& given);

FluidFields fields_of(gimdem_fluid_fields const& given);

std::vector<Monitor> monitors_of(gimdem_monitor const* given, std::size_t count);

gimdem_solid_fields plain(SolidFields const& fields, std::size_t cell_count);

}  // namespace gimdem::coupling::c
