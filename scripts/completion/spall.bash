# Completion of the command line of spall for bash.
_spall() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local commands="template check run report study shape bench verify"
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands --version --help" -- "$word")
    return
  fi
  case $before in
    --out | --figures | --preparations | --shapes | --csv | --page | --json | --save | --packing)
      mapfile -t COMPREPLY < <(compgen -f -- "$word")
      return
      ;;
    --geometry)
      mapfile -t COMPREPLY < <(compgen -W "sphere radial surface" -- "$word")
      return
      ;;
    --scene)
      mapfile -t COMPREPLY < <(compgen -W "rest jolt collapse" -- "$word")
      return
      ;;
    --from)
      mapfile -t COMPREPLY < <(compgen -W "rays vertices" -- "$word")
      return
      ;;
    --unit)
      mapfile -t COMPREPLY < <(compgen -W "m mm um" -- "$word")
      return
      ;;
  esac
  local words=
  case ${COMP_WORDS[1]} in
    template)
      words="dynamic_triaxial vibratory_compaction single_particle los_angeles
        subgrade scene parameters --json --out"
      ;;
    check) words="--preparations --json --set --help" ;;
    run)
      words="--out --preparations --threads --resume --overwrite --until --set
        --help"
      ;;
    report) words="--out --figures --help" ;;
    study)
      words="--out --finished --part --jobs --threads-per-case --ranks-per-case
        --mpirun --figures --page --set --help"
      ;;
    shape)
      words="--help"
      if [ "$COMP_CWORD" -eq 2 ]; then
        words="fit info corners generate --help"
      fi
      case ${COMP_WORDS[2]} in
        fit)
          words="--order --out --from --max-overhang --max-misfit --unit --json --source
            --licence"
          ;;
        info) words="--unit --json" ;;
        corners)
          words="--out --order --patch --from --max-overhang --max-misfit --unit
            --json"
          ;;
        generate) words="--count --seed --out --order --json" ;;
      esac
      ;;
    bench)
      words="--packing --steps --threads --shapes --geometry --breakage --scene
        --repeat --settle --copies --json --save --help"
      ;;
    verify) words="--list --csv --page --help" ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  if [[ $word != -* && ${COMP_WORDS[1]} != template ]]; then
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -o filenames -F _spall spall
