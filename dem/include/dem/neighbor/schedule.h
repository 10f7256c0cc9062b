#pragma once

#include <dem/neighbor/near_pairs.h>
#include <dem/neighbor/skin_width.h>

namespace dem
{
/// How fast what may meet moves in a step [m/s].
struct StepSpeeds
{
  double moving = 0.;  ///< centre of a particle, the fastest
  double closing = 0.; ///< any gap of a particle, the fastest
  double rigid = 0.;   ///< rigid boundaries
  double sheet = 0.;   ///< boundaries that deform
  double cell = 0.;    ///< images of a periodic cell
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
    displaced, ///< contacts have come to other places: lists within their skin
    sheets,    ///< lists of boundaries that deform alone
    all
  };

  /// One step has passed. `has_lists_of_sheets`: boundaries that deform have
  /// lists of their own.
  void advance(const StepSpeeds &fastest, double time_step,
               bool has_lists_of_sheets);
  /// What is due now. `is_too_wide()`, asked last: narrower lists would have
  /// paid.
  template <class Ask>
  Due due(bool has_lists_of_sheets, const Ask &is_too_wide) const
  {
    if (is_stale || skin.left < 0. || is_too_wide())
      return Due::all;
    if (has_displaced)
      return Due::displaced;
    return has_lists_of_sheets && (has_displaced_on_sheets || sheets_left < 0.)
               ? Due::sheets
               : Due::nothing;
  }
  /// A particle has grown by this at most [m].
  void grow(double length);

  void invalidate() { is_stale = true; }
  void note_displaced() { has_displaced = true; }
  void note_displaced_on_sheets() { has_displaced_on_sheets = true; }

  /// All lists were made within the skin, or those of sheets alone.
  void lists_made();
  void lists_of_sheets_made();
  /// A new skin was chosen with them.
  void skin_renewed() { is_stale = false; }

  SkinWidth skin;
  Travel travel;                ///< of pairs of particles
  double travelled = 0.;        ///< ForceContext::travelled [m]
  double stride = 0.;           ///< ForceContext::stride [m]
  double rigid_travelled = 0.;  ///< rigid boundaries, the fastest [m]
  double sheets_travelled = 0.; ///< those that deform, the fastest vertex [m]
  double sheets_left = 0.;      ///< of it and particles, to the next look [m]
  std::int64_t n_made = 0;      ///< times that lists were made

  /// Calls call(value) for all that a checkpoint keeps.
  template <class Self, class Visit>
  static void visit(Self &self, const Visit &call)
  {
    call(self.is_stale);
    call(self.has_displaced);
    call(self.has_displaced_on_sheets);
    call(self.skin);
    call(self.travel);
    call(self.travelled);
    call(self.rigid_travelled);
    call(self.sheets_travelled);
    call(self.sheets_left);
    call(self.n_made);
  }

private:
  bool is_stale = true;
  bool has_displaced = false;
  bool has_displaced_on_sheets = false;
};
} // namespace dem
