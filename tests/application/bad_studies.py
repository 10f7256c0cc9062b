"""Broken studies for bad_input.py."""
from bad_cases import LAB, Bad, prm

STUDY = ("subsection Study\n  set case = c.prm\n  set outcomes = n_events\n"
         "end\n")
SWEEP = "subsection Sweep\n  set Particle/density = 2000, 3000\nend\n"


def study(name, text, *message, options=""):
    return Bad("study_" + name, ["study", "s.prm", *options.split()],
               list(message), files={"s.prm": text, "c.prm": prm(LAB)})


STUDIES = [
    study("empty", STUDY, "s.prm", "Sweep"),
    study("key", STUDY + "subsection Sweep\n  set Particle/weight = 1, 2\nend\n",
          "s.prm:6", "Particle/weight", "no parameter"),
    study("value", STUDY + "subsection Sweep\n"
                           "  set Particle/density = 2000, heavy\nend\n",
          "Particle/density = heavy", "must be a number"),
    study("section", STUDY + SWEEP + "subsection Plot\n  set x = 1\nend\n",
          "s.prm:9", "Plot", "Study, Base, Sweep, Variants or Expect"),
    study("expect", STUDY + SWEEP + "subsection Expect\n"
                                    "  set a = n_events grows\nend\n",
          "s.prm:9", "rises"),
    study("outcome", STUDY + SWEEP +
          "subsection Expect\n  set a = laa rises with Particle/density\nend\n",
          "laa is not in Study/outcomes"),
    study("condition", STUDY + SWEEP +
          "subsection Expect\n  set a = n_events rises with Particle/density "
          "where Particle/density=1\nend\n",
          "Expect/a: Particle/density=1", "no case"),
    study("expect_of_variants", STUDY +
          "subsection Variants\n  set a = Particle/density=2000\n"
          "  set b = Particle/density=3000\nend\nsubsection Expect\n"
          "  set a = n_events rises with Particle/density\nend\n",
          "Expect/a: Particle/density is set by variants: must be Variants"),
    study("set_of_swept_key", STUDY.replace("end", "  set combine = grid\nend") +
          SWEEP, "--set Particle/density: is in section Sweep",
          options="--set Particle/density=1000"),
    study("base", STUDY + SWEEP +
          "subsection Base\n  set Particle/friction = -1\nend\n",
          "s.prm:9: Base: Particle/friction = -1: must be"),
    study("variant", STUDY +
          "subsection Variants\n  set a = Particle/friction=-1\nend\n",
          "s.prm:6: Variants/a: Particle/friction = -1: must be"),
    study("hole", STUDY + "subsection Sweep\n"
                          "  set Particle/density = 2000,, 3000\nend\n",
          "Particle/density = 2000,, 3000", "commas"),
    study("twice", STUDY + "subsection Variants\n  set a = Particle/friction=1; "
                           "Particle/friction=2\nend\n",
          "s.prm:6", "Particle/friction is set twice"),
    study("seed", STUDY.replace("end", "  set seeds = 5\nend") +
          "subsection Sweep\n  set Particle/seed = 3, 4\nend\n",
          "s.prm:7", "Sweep/Particle/seed", "Study/seeds"),
    study("page", STUDY + SWEEP, "--page c.prm",
          "must be a file with the line", options="--page c.prm"),
    study("out", STUDY + SWEEP, "--out .", "not a study", options="--out ."),
    study("finished", STUDY + SWEEP, "--finished: new", "no finished case",
          options="--finished --out new"),
    study("cycles", STUDY.replace("end", "  set after_cycles = 10, 5\nend") +
          SWEEP, "Study/after_cycles = 10, 5", "rising whole numbers"),
    Bad("study_nothing", ["study"], ["a study file must be given"]),
    Bad("study_jobs", ["study", "s.prm", "--jobs", "0"], ["--jobs 0"]),
    Bad("study_part", ["study", "s.prm", "--part", "3/2"],
        ["--part 3/2", "K from 1 to N"]),
    study("part_page", STUDY + SWEEP, "--part: writes no report",
          "without --finished", options="--part 1/2 --finished"),
]
