// SPDX-License-Identifier: BSD-3-Clause
/// Where the meshes of the ranks of one client meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gimdem/coupling/Types.hpp"

namespace gimdem::coupling::message
{

/// One face that two ranks have, each on the boundary of its own mesh. Point j of the first rank's face is point
/// (shift - j) mod n of the second's, whose order is reversed: either normal leaves its own rank.
struct FacePair
{
    std::size_t rank_a, rank_b;  ///< a < b
    std::size_t face_a, face_b;
    std::size_t shift;
};

/// Every pair, by the rule that both sides list the faces of a processor patch in the same order; checked by the
/// points' coordinates. Fault::mesh, naming ranks and patch, if the patches or their faces do not match.
///
/// @pre each part has passed find_mesh_fault().
std::vector<FacePair> find_face_pairs(std::vector<Mesh> const& parts);

}  // namespace gimdem::coupling::message
