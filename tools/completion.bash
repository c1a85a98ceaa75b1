# Bash completion of tilepress. Verbs, options and scheme names are asked of the command itself, once per shell.
_tilepress() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]} command=$1 i
  COMPREPLY=()
  declare -gA _tilepress_known
  if ((COMP_CWORD == 1)) || [[ $verb == help ]]; then
    [[ -v _tilepress_known[verbs] ]] ||
      _tilepress_known[verbs]="$("$command" help 2>/dev/null | sed -n '/^Verbs:/,/^$/s/^  \([a-z-]*\) .*/\1/p')"
    mapfile -t COMPREPLY < <(compgen -W "${_tilepress_known[verbs]} --help --version" -- "$current")
    return
  fi
  # Behind -- stands a program and its own arguments.
  for ((i = 2; i < COMP_CWORD; i++)); do
    [[ ${COMP_WORDS[i]} == -- ]] || continue
    if declare -F _command_offset >/dev/null; then
      _command_offset $((i + 1))
    elif ((COMP_CWORD == i + 1)); then
      mapfile -t COMPREPLY < <(compgen -c -- "$current")
    fi
    return
  done
  case $previous in
    -s | --scheme)
      [[ -v _tilepress_known[schemes] ]] ||
        _tilepress_known[schemes]="$("$command" schemes --json 2>/dev/null | sed -n 's/^    "name": "\(.*\)",$/\1/p')"
      mapfile -t COMPREPLY < <(compgen -W "${_tilepress_known[schemes]}" -- "$current")
      return ;;
    --format)
      case $verb in
        compare) mapfile -t COMPREPLY < <(compgen -W "text markdown csv" -- "$current") ;;
        export) mapfile -t COMPREPLY < <(compgen -W "gem5 jsonl" -- "$current") ;;
        pack | vectors) mapfile -t COMPREPLY < <(compgen -W "rgba rgb565 rgb10a2" -- "$current") ;;
        unpack) mapfile -t COMPREPLY < <(compgen -W "png raw rgba" -- "$current") ;;
      esac
      return ;;
    --heatmaps | --dump-frames) mapfile -t COMPREPLY < <(compgen -W "every:" -- "$current"); return ;;
    --dram) mapfile -t COMPREPLY < <(compgen -W "paper lpddr3 lpddr4 lpddr5" -- "$current"); return ;;
    --toggles) mapfile -t COMPREPLY < <(compgen -W "16 32" -- "$current"); return ;;
    --progress) mapfile -t COMPREPLY < <(compgen -W "auto never json" -- "$current"); return ;;
    --via) mapfile -t COMPREPLY < <(compgen -W "auto preload glvnd" -- "$current"); return ;;
    --api) mapfile -t COMPREPLY < <(compgen -W "auto egl glx" -- "$current"); return ;;
    --display) mapfile -t COMPREPLY < <(compgen -W "auto surfaceless xvfb x11" -- "$current"); return ;;
    --overlay) mapfile -t COMPREPLY < <(compgen -W "blend only off" -- "$current"); return ;;
    --trigger) mapfile -t COMPREPLY < <(compgen -W "finish flush readpixels" -- "$current"); return ;;
    --targets) mapfile -t COMPREPLY < <(compgen -W "presented all" -- "$current"); return ;;
    --readback) mapfile -t COMPREPLY < <(compgen -W "auto sync async in-context" -- "$current"); return ;;
    --on-full) mapfile -t COMPREPLY < <(compgen -W "block drop" -- "$current"); return ;;
    --log-level) mapfile -t COMPREPLY < <(compgen -W "trace debug info warn error off" -- "$current"); return ;;
  esac
  if [[ $current == -* ]]; then
    [[ -v _tilepress_known[$verb] ]] ||
      _tilepress_known[$verb]="$("$command" help "$verb" 2>/dev/null | grep -oE '(^|[ ,])--[a-z][a-z-]*' | tr -d ' ,' | sort -u)"
    mapfile -t COMPREPLY < <(compgen -W "${_tilepress_known[$verb]}" -- "$current")
  fi
}
complete -o default -o bashdefault -F _tilepress tilepress
