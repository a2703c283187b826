# objects.awk - what objects refer to and hold that they should not
# SPDX-License-Identifier: MIT
#
# usage: nm -A OBJECTS | awk -f objects.awk
#
# Prints "KIND OBJECT:SYMBOL": float, a helper of floating point, every ABI's
# spelling, or the heap; wide, of 64-bit division; other, what is neither the
# core's or the port's nor a helper of integers; static, what can be written and
# outlives a call. Two lines of nm -A:
#
#   ql_bvh.o:         U memcpy
#   ql_bvh.o:00000000 T ql_bvh_closest

{
    file = $1
    sub(/:.*/, "", file)
    type = $(NF - 1)
    symbol = $NF
}

type == "U" {
    undefined[file ":" symbol] = symbol
    next
}

type ~ /[A-Z]/ { defined[symbol] = 1 }

# An AVR has constants in its memory too.
type ~ /[bBcCdDgGsS]/ { held[file ":" symbol] = 1 }

symbol == "__do_copy_data" { avr = 1 }

# What memory and integers need that is no instruction: on every CPU, on ARM,
# and by libgcc's names, as __umulsidi3 or AVR's __cmpdi2_s8
function is_helper(s)
{
    return s ~ /^mem(cpy|set)$/ || s == "_GLOBAL_OFFSET_TABLE_" ||
        s ~ /^__aeabi_(l(mul|lsl|lsr|asr)|u?idiv(mod)?)$/ ||
        s ~ /^__gnu_thumb1_case_/ || s ~ /^__do_(clear_bss|copy_data)$/ ||
        s ~ /^__u?(add|sub|neg|cmp|mul|(div)?mod|div|clz|bswap|ash[lr]|lshr)/ &&
        s ~ /[a-z]u?([hsd]i)+[234](_s8)?$/
}

END {
    for (key in undefined) {
        s = undefined[key]
        if (s ~ /^__aeabi_([fd]|[ui]l?2[fd]|c[df])/ ||
            s ~ /^__(.*(sf|df|xf|tf)[0-9]*$|fix|float)/ ||
            s ~ /^(malloc|calloc|realloc|free|_sbrk|printf|abort)/) {
            print "float", key
        } else if (s ~ /^__aeabi_u?ldivmod$|^__u?(div|mod)di3|^__udivmoddi4/) {
            print "wide", key
        } else if (!(s in defined) && !is_helper(s) &&
            s !~ /^ql_(hal_|assert_fail$)/) {
            print "other", key
        }
        avr = avr || s == "__do_copy_data"
    }
    for (key in held) {
        if (!avr) {
            print "static", key
        }
    }
}
