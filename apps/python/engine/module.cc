#include "bindings.h"

PYBIND11_MODULE(spall_engine, module)
{
  module.doc() =
      "The particle engine of Spall in the process of Python: particles, "
      "contacts, breakage, walls. SI units. Vectors are numpy arrays of three "
      "numbers; columns of all particles are views of the memory of the "
      "engine, without copies, and hold until a particle is added.";
  bind_parameters(module);
  bind_engine(module);
}
