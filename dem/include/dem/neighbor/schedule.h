#pragma once

#include <dem/neighbor/near_pairs.h>
#include <dem/neighbor/skin_width.h>

namespace dem
{
/// How fast what may meet moves in a step [m/s].
struct StepSpeeds
{
  double moving = 0.;    ///< centre of a particle, the fastest
  double closing = 0.;   ///< any gap of a particle, the fastest
  double rigid = 0.;     ///< rigid boundaries
  double deforming = 0.; ///< boundaries that deform
  double cell = 0.;      ///< images of a periodic cell
};

/// Decides when which lists of contacts are rebuilt: they hold as long as no
/// particle can have come to a contact that is not listed. All distances are
/// upper bounds that grow with every step.
class NeighborSchedule
{
public:
  enum class Due
  {
    nothing,
    displaced, ///< other contact points of contacts: lists within their skin
    deforming, ///< lists of boundaries that deform alone
    all
  };

  /// One step has passed. `has_deforming_lists`: boundaries that deform have
  /// lists of their own.
  void advance(const StepSpeeds &fastest, double time_step,
               bool has_deforming_lists);
  /// What is due now. `is_too_wide()`, called last: narrower lists would have
  /// paid.
  template <class Ask>
  Due due(bool has_deforming_lists, const Ask &is_too_wide) const
  {
    if (is_stale || skin.left < 0. || is_too_wide())
      return Due::all;
    if (has_displaced)
      return Due::displaced;
    return has_deforming_lists &&
                   (has_displaced_on_deforming || deforming_left < 0.)
               ? Due::deforming
               : Due::nothing;
  }
  /// A particle has grown by this at most [m].
  void grow(double length);

  void invalidate() { is_stale = true; }
  /// Whether contact points have displaced since the lists were made.
  bool displaced() const { return has_displaced; }
  void note_displaced() { has_displaced = true; }
  bool displaced_on_deforming() const { return has_displaced_on_deforming; }
  void note_displaced_on_deforming() { has_displaced_on_deforming = true; }

  /// All lists were made within the skin, or those of deforming surfaces alone.
  void lists_made();
  void deforming_lists_made();
  /// A new skin was chosen with them.
  void skin_renewed() { is_stale = false; }

  SkinWidth skin;
  PathLengths paths;          ///< of pairs of particles
  double path_length = 0.;    ///< ForceContext::path_length [m]
  double step_path = 0.;      ///< ForceContext::step_path [m]
  double rigid_path = 0.;     ///< rigid boundaries, the fastest [m]
  double deforming_path = 0.; ///< those that deform, the fastest vertex [m]
  double deforming_left = 0.; ///< of it and particles, to the next check [m]
  std::int64_t n_made = 0;    ///< times that lists were made

  /// Calls call(value) for all that a checkpoint stores.
  template <class Self, class Visit>
  static void visit(Self &self, const Visit &call)
  {
    call(self.is_stale);
    call(self.has_displaced);
    call(self.has_displaced_on_deforming);
    call(self.skin);
    call(self.paths);
    call(self.path_length);
    call(self.rigid_path);
    call(self.deforming_path);
    call(self.deforming_left);
    call(self.n_made);
  }

private:
  bool is_stale = true;
  bool has_displaced = false;
  bool has_displaced_on_deforming = false;
};
} // namespace dem
