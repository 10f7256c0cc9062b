#include <coupling/exchange.h>

#include <cmath>

// The stiffness of contacts in the implicit steps of bodies
// (docs/theory/interface.md).
namespace coupling
{
namespace
{
/// Twice what the mean load over the window gives way by, as its end moves.
Eigen::Matrix3d give(const ContactTangent &tangent, std::size_t k,
                     double window)
{
  return tangent.springs[k] + 2. / window * tangent.dashpots[k];
}
} // namespace

/// Of the contacts that are there, on the nodes that take it and move freely;
/// false: there are none.
bool Exchange::find_tangent(Joint &joint, const dem::Engine &engine,
                            double window) const
{
  const std::size_t n = joint.body->n_sprung();
  if (!parameters.has_contact_tangent || n == 0)
    return false;
  for (auto *column : {&joint.tangent.springs, &joint.tangent.dashpots})
    column->assign(joint.at.size(), Eigen::Matrix3d::Zero());
  joint.seam->add_tangent(engine, joint.tangent);
  const std::vector<double> mass = joint.body->nodal_mass();
  joint.springs.stiffness.clear();
  for (std::size_t k = 0; k < n; ++k)
    joint.springs.stiffness.push_back(std::isinf(mass[k])
                                          ? Eigen::Matrix3d::Zero()
                                          : give(joint.tangent, k, window));
  return true;
}

/// The loads are means of the last window, in which nodes went from `from` to
/// where they are now; now they go from `at`.
void Exchange::predict_with_tangent(Joint &joint, double window) const
{
  const FieldView now = joint.body->motion().position;
  const std::size_t n = joint.springs.stiffness.size();
  Field load = joint.load;
  joint.springs.rest.assign(joint.at.begin(),
                            joint.at.begin() + std::ptrdiff_t(n));
  for (std::size_t k = 0; k < n; ++k)
    if (!joint.springs.stiffness[k].isZero(0.))
    {
      const Eigen::Vector3d went = now[k] - joint.from[k];
      load[k] += 0.5 * joint.tangent.springs[k] *
                     (joint.from[k] - joint.at[k] + now[k] - joint.at[k]) +
                 joint.tangent.dashpots[k] * went / window;
    }
  joint.body->advance(load, window, &joint.springs);
}

/// What the contacts would have given, had they seen the body come to where it
/// comes: its load then.
void Exchange::correct_with_tangent(Joint &joint, double window) const
{
  const std::size_t n = joint.springs.stiffness.size();
  joint.springs.rest.assign(joint.target.begin(),
                            joint.target.begin() + std::ptrdiff_t(n));
  joint.body->advance(joint.load, window, &joint.springs);
  const FieldView now = joint.body->motion().position;
  for (std::size_t k = 0; k < n; ++k)
    joint.load[k] -=
        0.5 * joint.springs.stiffness[k] * (now[k] - joint.springs.rest[k]);
}
} // namespace coupling
