# Bash completion of tilepress. The command's own help has the verbs, the options and the values of options.
_tilepress_help() {
  declare -gA _tilepress_known
  [[ -v _tilepress_known[$2] ]] || _tilepress_known[$2]="$("$1" help ${2#-} 2>/dev/null)"
  printf '%s\n' "${_tilepress_known[$2]}"
}

_tilepress() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]} command=$1 i words=
  COMPREPLY=()
  if ((COMP_CWORD == 1)) || [[ $verb == help ]]; then
    words="$(_tilepress_help "$command" - | sed -n '/^Verbs:/,/^$/s/^  \([a-z-]*\) .*/\1/p') --help --version"
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
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
    -s | --scheme) words=$("$command" schemes --json 2>/dev/null | sed -n 's/^    "name": "\(.*\)",$/\1/p') ;;
    -?*)
      # The form of a value: a|b|c, or every:N.
      words=$(_tilepress_help "$command" "$verb" | sed -nE "s/^  (-.,)?$previous(,--[a-z-]+)? ([^ ]*).*/\3/p" |
        sed -nE '/\|/{s/:.*//;s/\|/ /gp;};s/^every:N$/every:/p') ;;
  esac
  if [[ -z $words && $current == -* ]]; then
    words=$(_tilepress_help "$command" "$verb" | sed -nE 's/^  (-.,)?(--[a-z][a-z-]*).*/\2/p')
  fi
  [[ -z $words ]] || mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}
complete -o default -o bashdefault -F _tilepress tilepress
