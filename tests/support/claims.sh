# claims.sh - how a script says what holds: a line a claim; scripts source it
# SPDX-License-Identifier: MIT
#
# Before: suite=FOLDER/NAME. After: $failures counts the claims that fail; a
# script ends with exit $((failures > 0)). tests/run.sh counts the same lines.
# UNTIL="CLAIM..." in the environment ends a script earlier: when it has said
# all of these, or at the first claim that fails.

failures=0
columns='%-20s %-52s' # of suite and claim

# say_as SUITE CLAIM ok|FAIL [NOTE], in one piece: jobs print side by side
say_as() {
    line=$(printf "$columns %-4s %s" "$1" "$2" "$3" "${4-}")
    printf '%s\n' "$line"
    [ "$3" = ok ] || failures=$((failures + 1))
    [ -z "${UNTIL-}" ] || end_early "$2"
}

# end_early CLAIM: it was said; is it the last one wanted, or one that fails?
end_early() {
    [ $failures -eq 0 ] || exit 1
    case " $UNTIL " in
    " $1 ") exit 0 ;;
    *" $1 "*) UNTIL=$(printf %s " $UNTIL " | sed "s/ $1 / /; s/^ //; s/ $//") ;;
    esac
}

# say CLAIM STATUS [NOTE]: it holds if STATUS is 0
say() {
    if [ "$2" -eq 0 ]; then
        say_as "$suite" "$1" ok "${3-}"
    else
        say_as "$suite" "$1" FAIL "${3-}"
    fi
}

# say_none CLAIM FAULTS: it holds if there are none; else the first are named
say_none() {
    [ -z "$2" ]
    say "$1" $? "$(printf '%s\n' "$2" | head -n 5 | paste -s -d ' ' -)"
}
