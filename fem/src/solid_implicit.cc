#include "solid_state.h"

#include <stdexcept>

namespace fem
{
namespace
{
using Vector = Eigen::Vector3d;

bool operator==(const SystemWeights &a, const SystemWeights &b)
{
  return a.mass == b.mass && a.dashpot == b.dashpot &&
         a.stiffness == b.stiffness;
}
} // namespace

ImplicitRule generalised_alpha(double spectral_radius)
{
  if (!(spectral_radius >= 0. && spectral_radius <= 1.))
    throw std::invalid_argument(
        "solid: spectral radius = " + std::to_string(spectral_radius) +
        ", must be from 0 to 1");
  ImplicitRule rule;
  rule.alpha_m = (2. * spectral_radius - 1.) / (spectral_radius + 1.);
  rule.alpha_f = spectral_radius / (spectral_radius + 1.);
  rule.gamma = 0.5 - rule.alpha_m + rule.alpha_f;
  rule.beta = 0.25 * (0.5 + rule.gamma) * (0.5 + rule.gamma);
  return rule;
}

const SparseFactor &Solid::State::factor(const SystemWeights &weights)
{
  const int version = supports.version() + n_dashpot_changes;
  if (!kept.factor || kept.version != version || !(kept.weights == weights))
  {
    kept.factor.reset(); // its memory first
    kept.factor.emplace(assemble(parts(), weights));
    kept.weights = weights;
    kept.version = version;
  }
  return *kept.factor;
}

void Solid::advance(std::span<const Vector> load, double time_step,
                    const ImplicitRule &rule)
{
  check_solid_step(time_step);
  check_solid_loads(load.size(), state->mass.size());
  SolidMotion &now = state->now;
  const SolidSupports &supports = state->supports;
  const double damping = state->parameters.stiffness_damping;
  const double end = 1. - rule.alpha_f;
  const SparseFactor &factor = state->factor(
      {1. - rule.alpha_m, end * rule.gamma * time_step,
       end * (rule.beta * time_step + damping * rule.gamma) * time_step});
  state->put_supports_in_motion();
  const std::size_t n = state->mass.size();
  if (!now.has_acceleration)
    for (std::size_t k = 0; k < n; ++k)
      for (int c = 0; c < 3; ++c)
        now.acceleration[k](c) =
            supports.unknown(k, c) < 0
                ? 0.
                : (state->force(k) - state->dashpot[k] * now.velocity[k])(c) /
                      state->mass[k];
  now.has_acceleration = true;

  // Predicted without the new accelerations; the matrix adds their share.
  NodeField start = now.displacement, speed = now.velocity, mixed(n);
  for (std::size_t k = 0; k < n; ++k)
  {
    now.displacement[k] +=
        time_step *
        (speed[k] + (0.5 - rule.beta) * time_step * now.acceleration[k]);
    now.velocity[k] += (1. - rule.gamma) * time_step * now.acceleration[k];
    mixed[k] = end * (now.displacement[k] + damping * now.velocity[k]) +
               rule.alpha_f * (start[k] + damping * speed[k]);
  }
  supports.spread(mixed);
  NodeField internal(n);
  state->elastic.multiply(mixed, internal);
  supports.collect(internal);
  NodeField old_load = now.load, next(n, Vector::Zero());
  NodeField new_load(load.begin(), load.end());
  supports.collect(new_load);
  for (std::size_t k = 0; k < n; ++k)
    next[k] =
        end * new_load[k] + rule.alpha_f * old_load[k] -
        rule.alpha_m * state->mass[k] * now.acceleration[k] -
        state->dashpot[k] * (end * now.velocity[k] + rule.alpha_f * speed[k]) -
        internal[k];
  from_unknowns(supports, factor.solve(to_unknowns(supports, next)),
                now.acceleration);

  // Forces at the start of the step do their half of the work first.
  NodeField predicted = now.displacement, predicted_speed = now.velocity;
  now.velocity = speed;
  for (std::size_t k = 0; k < n; ++k)
  {
    predicted[k] += rule.beta * time_step * time_step * now.acceleration[k];
    predicted_speed[k] += rule.gamma * time_step * now.acceleration[k];
    now.moved[k] = predicted[k] - start[k];
  }
  state->book_half_step();
  now.displacement = predicted;
  now.velocity = predicted_speed;
  supports.spread(now.displacement);
  supports.spread(now.velocity);
  state->set_load(load);
  state->update_forces();
  state->book_half_step();
}

void Solid::settle(std::span<const Vector> load)
{
  check_solid_loads(load.size(), state->mass.size());
  SolidMotion &now = state->now;
  const SolidSupports &supports = state->supports;
  const SparseFactor &factor = state->factor({0., 0., 1.});
  now.done.damping += energy().kinetic; // brought to rest
  const std::size_t n = state->mass.size();
  now.velocity.assign(n, Vector::Zero());
  now.acceleration = now.viscous = now.velocity;
  now.has_acceleration = true;

  NodeField start = now.displacement, target = now.displacement, internal(n);
  for (std::size_t k = 0; k < n; ++k)
    for (int c = 0; c < 3; ++c)
      if (supports.is_fixed(k, c))
        target[k](c) = now.support_displacement[k](c);
  supports.spread(target);
  state->elastic.multiply(target, internal);
  supports.collect(internal);
  NodeField residual(load.begin(), load.end());
  supports.collect(residual);
  for (std::size_t k = 0; k < n; ++k)
    residual[k] -= internal[k];
  NodeField change(n, Vector::Zero());
  from_unknowns(supports, factor.solve(to_unknowns(supports, residual)),
                change);
  for (std::size_t k = 0; k < n; ++k)
    now.moved[k] = target[k] + change[k] - start[k];
  supports.spread(now.moved);
  state->book_half_step();
  for (std::size_t k = 0; k < n; ++k)
    now.displacement[k] = start[k] + now.moved[k];
  state->set_load(load);
  state->update_forces();
  state->book_half_step();
}
} // namespace fem
