# Fish completion of tilepress. The command's own help has the verbs, the options and the values of options.
function __tilepress_candidates
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    set -l command $words[1]
    set -l verb $words[2]
    if test (count $words) -eq 1; or test "$verb" = help
        $command help 2>/dev/null | sed -nE '/^Verbs:/,/^$/s/^  ([a-z-]+) +(.*)/\1\t\2/p'
        return
    end
    # Behind -- stands a program and its own arguments.
    if set -l place (contains -i -- -- $words)
        complete -C (string join ' ' -- $words[(math $place + 1)..] $current)
        return
    end
    set -l previous $words[-1]
    set -l found
    switch $previous
        case -s --scheme
            set found ($command schemes --json 2>/dev/null | sed -n 's/^    "name": "\(.*\)",$/\1/p')
        case '-?*'
            # The form of a value: a|b|c, or every:N.
            set found ($command help $verb 2>/dev/null | sed -nE "s/^  (-.,)?$previous(,--[a-z-]+)? ([^ ]*).*/\3/p" |
                sed -nE '/\|/{s/:.*//;s/\|/\n/gp;};s/^every:N$/every:/p')
    end
    if test -n "$found"
        printf '%s\n' $found
    else if string match -q -- '-*' "$current"
        $command help $verb 2>/dev/null |
            sed -nE 's/^  (-.,)?(--[a-z][a-z-]*).*  +([^ ].*)/\2\t\3/p;t;s/^  (-.,)?(--[a-z][a-z-]*).*/\2/p'
    else
        __fish_complete_path "$current"
    end
end
complete -c tilepress -f -a '(__tilepress_candidates)'
