#include <dem/binary.h>
#include <dem/shape/shape_stream.h>

namespace dem
{
void write_measures(std::ostream &out, const ParticleShape &shape)
{
  for (const double value :
       {shape.scale, shape.volume, shape.inscribed_radius, shape.corner_radius,
        shape.circumscribed_radius, shape.least_radius, shape.max_slope})
    write_value(out, value);
  write_value(out, shape.gyration);
  write_value(out, shape.principal.coeffs());
}

void read_measures(std::istream &in, ParticleShape &shape)
{
  for (double *value : {&shape.scale, &shape.volume, &shape.inscribed_radius,
                        &shape.corner_radius, &shape.circumscribed_radius,
                        &shape.least_radius, &shape.max_slope})
    read_value(in, *value);
  read_value(in, shape.gyration);
  read_value(in, shape.principal.coeffs());
}
} // namespace dem
