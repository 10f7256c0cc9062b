#include "program/program.h"

int main(int argc, char **argv)
{
  return spall::program_main(argc, argv);
}
