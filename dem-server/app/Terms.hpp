// SPDX-License-Identifier: BSD-3-Clause
/// What the case file fixes and the client is told.
#pragma once

#include "core/Case.hpp"
#include "gimdem/coupling/Server.hpp"

namespace gimdem::app
{

coupling::ServerTerms terms_of(Case const& settings);

/// The schedule in force: the client's wish if it has one.
coupling::Schedule schedule_of(Case const& settings, coupling::ClientInfo const& client);

}  // namespace gimdem::app
