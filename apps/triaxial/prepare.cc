#include "errors.h"
#include "triaxial/triaxial.h"

#include <dem/io/binary.h>

#include <sstream>

namespace spall
{
namespace
{
/// How often the preparation is asked whether it is at rest [steps].
constexpr std::int64_t rest_interval = 200;
} // namespace

void Triaxial::prepare()
{
  servo.update(engine(), pace.step());
  engine().advance(pace.step());
  pace.count();
  ++in_stage;
  if (in_stage % rest_interval == 0 && is_at_rest())
  {
    preparation.time = engine().time();
    preparation.porosity =
        1. - solid_volume(engine().particles()) /
                 dem::box_size(engine(), specimen.box).prod();
    if (call_prepared)
      call_prepared();
    hand_over();
  }
  else if (engine().time() > parameters.preparation.max_time)
    throw RunFailure(unprepared_text());
}

std::string Triaxial::unprepared_text() const
{
  std::ostringstream text;
  text << "preparation is not at rest after " << parameters.preparation.max_time
       << " s: stress " << preparation.stress.transpose() << " Pa (target "
       << parameters.preparation.pressure << "), unbalanced force ratio "
       << preparation.unbalanced_ratio << " (limit "
       << parameters.preparation.unbalanced_ratio
       << "): see Preparation/max_time, friction, local_damping";
  return text.str();
}

bool Triaxial::is_at_rest()
{
  preparation.stress = dem::box_stress(engine(), specimen.box);
  preparation.unbalanced_ratio =
      dem::unbalanced_force_ratio(engine().particles(), engine().pairs());
  const PreparationParameters &limits = parameters.preparation;
  const double worst =
      (preparation.stress.array() / limits.pressure - 1.).abs().maxCoeff();
  return worst < limits.stress_tolerance &&
         preparation.unbalanced_ratio < limits.unbalanced_ratio &&
         dem::contact_network(engine().particles(), engine().pairs())
                 .n_contacts > 0;
}

void Triaxial::save_prepared(std::ostream &out) const
{
  dem::write_value(out, watch.state());
  dem::write_value(out, preparation);
  engine().save(out, specimen.shapes);
  servo.save(out);
}

void Triaxial::take_prepared(std::istream &in)
{
  StepRecord record;
  dem::read_value(in, record);
  watch.set_state(record);
  dem::read_value(in, preparation);
  preparation.is_taken = 1;
  engine().restore(in, specimen.shapes);
  servo.restore(in);
  hand_over();
}

/// From the six planes to what closes the specimen from now on.
void Triaxial::hand_over()
{
  place_boundaries();
  enter(Stage::consolidation);
}

void Triaxial::place_boundaries()
{
  const auto &planes = engine().planes();
  for (int d = 0; d < 3; ++d)
  {
    const auto &[low, high] = specimen.box[static_cast<std::size_t>(d)];
    lower[d] = planes[low].point[d];
    upper[d] = planes[high].point[d];
  }
  area = (upper - lower).head<2>().prod();
  servo.release(engine(), 2);
  // Stones that carry nothing would fly on for ever.
  engine().come_to_rest();
  engine().set_friction(parameters.stone.friction);
  engine().set_local_damping(parameters.time.local_damping);
  const dem::Plane &top = planes[specimen.box[2][1]];
  plane_work_gone = top.work;
  build_cell();
  cell->set_plate({upper.z(), 0., -parameters.preparation.pressure * area,
                   top.force.z(), 0.});
}
} // namespace spall
