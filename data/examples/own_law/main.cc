// The program of Spall whose cases may name the contact law "cone".
#include "cone_law.h"

#include <program/program.h>

int main(int argc, char **argv)
{
  add_cone_law();
  return spall::program_main(argc, argv);
}
