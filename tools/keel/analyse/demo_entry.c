/* SPDX-License-Identifier: Apache-2.0 */
/* How Eva starts the demo: alone, or with arguments that say anything. With one argument the length
 * of a turn would be unknown, and so every time in the run: the two that are refused do here. */
#include "__fc_builtin.h"

#define LONGEST 16u

int main(int argc, char **argv);

int keel_eva_entry(void)
{
    char name[] = "demo";
    char any[LONGEST];
    char *alone[] = {name, (char *)0};
    char *many[] = {name, any, any, (char *)0};

    Frama_C_make_unknown(any, LONGEST - 1u);
    any[LONGEST - 1u] = '\0';
    return (Frama_C_interval(0, 1) == 0) ? main(3, many) : main(1, alone);
}
