#include <coupling/exchange.h>
#include <dem/binary.h>

// The state of an exchange in a checkpoint and before a window.
namespace coupling
{
void Exchange::save(std::ostream &out) const
{
  for (const CoupledBody &coupled : coupled_bodies)
  {
    coupled.body->save(out);
    dem::write_column(out, coupled.at);
    dem::write_column(out, coupled.load);
    dem::write_column(out, coupled.from);
  }
  dem::write_value(out, books);
  dem::write_value(out, pass_count);
  dem::write_value(out, window_count);
  dem::write_value(out, unsettled_count);
  dem::write_value(out, step_count);
  dem::write_value(out, length);
}

void Exchange::restore(std::istream &in)
{
  held_events.clear(); // of windows that have not been
  for (CoupledBody &coupled : coupled_bodies)
  {
    coupled.body->restore(in);
    dem::read_column(in, coupled.at);
    dem::read_column(in, coupled.load);
    dem::read_column(in, coupled.from);
  }
  dem::read_value(in, books);
  dem::read_value(in, pass_count);
  dem::read_value(in, window_count);
  dem::read_value(in, unsettled_count);
  dem::read_value(in, step_count);
  dem::read_value(in, length);
}
} // namespace coupling
