#include <coupling/relaxation.h>

#include <algorithm>

namespace coupling
{
void Relaxation::correct(FieldView residual, Field &guess)
{
  if (parameters.kind == RelaxationKind::aitken && !before.empty())
  {
    double along = 0., squared = 0.;
    for (std::size_t k = 0; k < residual.size(); ++k)
    {
      const Eigen::Vector3d change = residual[k] - before[k];
      along += before[k].dot(change);
      squared += change.squaredNorm();
    }
    if (squared > 0.)
      omega = std::clamp(-omega * along / squared, parameters.lowest,
                         parameters.highest);
  }
  before.assign(residual.begin(), residual.end());
  for (std::size_t k = 0; k < guess.size(); ++k)
    guess[k] += omega * residual[k];
}
} // namespace coupling
