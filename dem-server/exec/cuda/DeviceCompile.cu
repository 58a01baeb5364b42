// SPDX-License-Identifier: BSD-3-Clause
/// Proof that the laws and the integrator compile for a GPU: each is instantiated in a device kernel. The CUDA backend
/// that launches them is not there yet; nothing here runs.
#include "contact/ContactLaws.hpp"
#include "forces/Beetstra.hpp"
#include "integrate/VelocityVerlet.hpp"
#include "mapping/GaussianIntegral.hpp"
#include "mesh/PointLocator.hpp"
#include "walls/Triangle.hpp"

namespace gimdem::exec
{

namespace
{

template <class Kernel>
__global__ void launch(std::int64_t count, Kernel kernel)
{
    auto const i = static_cast<std::int64_t>(blockIdx.x) * blockDim.x + threadIdx.x;
    if (i < count) kernel(i);
}

/// One call of every pointwise law.
struct AllLaws
{
    Quad const* position;
    MeshKernelView mesh;
    ContactLaw<HertzMindlinLaw, ElasticPlasticSpring, Sjkr>::Constants<double> hertz;
    ContactLaw<LinearSpringDashpot, ConstantTorque>::Constants<double> linear;
    Quad* displacement;
    double* out;

    GIMDEM_HD void operator()(std::int64_t i) const
    {
        Vec3 const x = position[i].xyz();
        Location const at = CellWalker{mesh}(0, x);
        Vec3 spring = displacement[i].xyz();
        ContactGeometry<double> const touch{{0, 0, 1}, 1e-6, vector3(x), 1e-3, 1e-6, vector3(x), 1e9, 0};
        ContactSprings<double> springs{vector3(spring), {0, 0, 0}};
        ContactLaw<LinearSpringDashpot, ConstantTorque>::apply<double>(linear, 1e-6, touch, springs);
        ContactForce<double> const contact =
            ContactLaw<HertzMindlinLaw, ElasticPlasticSpring, Sjkr>::apply<double>(hertz, 1e-6, touch, springs);
        displacement[i] = Quad::of(vec3(springs.tangential), 0);
        GaussianIntegral const integral{position[i].w, 1.0, tuned_coefficient(1.0)};
        out[i] = integral(x.norm()) + beetstra_factor(0.5, at.outside) + contact.force.x +
                 closest_on_triangle(x, spring, vec3(contact.tangential), x).point.norm();
    }
};

}  // namespace

/// Keeps the instantiations.
void compile_for_device()
{
    launch<HalfKick<true>><<<1, 1>>>(0, HalfKick<true>{});
    launch<Drift><<<1, 1>>>(0, Drift{});
    launch<AllLaws><<<1, 1>>>(0, AllLaws{});
}

}  // namespace gimdem::exec
