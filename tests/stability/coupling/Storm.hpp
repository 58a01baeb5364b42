// SPDX-License-Identifier: BSD-3-Clause
/// The parts of the storm. Each prints its figures and returns how many things went wrong, having told each.
#pragma once

namespace gimdem::test
{

/// Sessions from Hello to Goodbye, one after the other, both ends in this process: memory and descriptors stay flat.
int run_cycles(int count);

/// Faults of random kinds between two processes: each ends, in time, for a reason that fits.
int run_faults(int count, unsigned seed);

/// One session between two processes, about a hundred steps a second: memory and descriptors stay flat.
int run_soak(double seconds);

}  // namespace gimdem::test
