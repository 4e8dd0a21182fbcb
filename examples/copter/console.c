/* SPDX-License-Identifier: Apache-2.0 */
/* What can be asked of the copter in words. */
#include "console.h"

#include "copter.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#define COMMANDS 2u

/* A command, and who makes a line of its answer. */
typedef struct command {
    const char *name;
    const char *meaning;
    uint32_t (*line)(const copter_t *copter, uint32_t number, char line[COPTER_CONSOLE_LINE]);
} command_t;

static uint32_t help_line(const copter_t *copter, uint32_t number, char line[COPTER_CONSOLE_LINE]);
static uint32_t tasks_line(const copter_t *copter, uint32_t number, char line[COPTER_CONSOLE_LINE]);

static const command_t commands[COMMANDS] = {
    {"help", "these commands", help_line},
    {"tasks", "how each task has run since the start", tasks_line},
};

/* As much of a text as there is room for, and the end of line. */
static uint32_t append_text(char line[COPTER_CONSOLE_LINE], uint32_t at, const char *text)
{
    uint32_t end = at;

    for (uint32_t i = 0u; (text[i] != '\0') && (end < (COPTER_CONSOLE_LINE - 1u)); i++) {
        line[end] = text[i];
        end++;
    }
    line[end] = '\0';
    return end;
}

static uint32_t help_line(const copter_t *copter, uint32_t number, char line[COPTER_CONSOLE_LINE])
{
    uint32_t length = 0u;

    (void)copter;
    if (number < COMMANDS) {
        length = append_text(line, append_text(line, 0u, commands[number].name), ": ");
        length = append_text(line, append_text(line, length, commands[number].meaning), "\n");
    }
    return length;
}

static uint32_t tasks_line(const copter_t *copter, uint32_t number, char line[COPTER_CONSOLE_LINE])
{
    return keel_task_table_line(&copter->table, &copter->scheduler, number, line);
}

/* Whoever asks nothing is told nothing. */
static uint32_t refusal_line(const char *typed, uint32_t number, char line[COPTER_CONSOLE_LINE])
{
    uint32_t length = 0u;

    if ((number == 0u) && (typed[0] != '\0')) {
        length = append_text(line, append_text(line, 0u, "no such command: "), typed);
        length = append_text(line, length, "; there are: ");
        for (uint32_t i = 0u; i < COMMANDS; i++) {
            length = append_text(line, append_text(line, length, (i == 0u) ? "" : ", "),
                                 commands[i].name);
        }
        length = append_text(line, length, "\n");
    }
    return length;
}

void copter_console_ask(copter_said_t *answer, const char *typed, uint32_t length)
{
    uint32_t first = 0u;
    uint32_t end = length;

    while ((first < end) && (typed[first] == ' ')) {
        first++;
    }
    while ((end > first) && (typed[end - 1u] == ' ')) {
        end--;
    }
    *answer = (copter_said_t){.lines = 0u};
    for (uint32_t i = 0u; (i < (end - first)) && (i < (COPTER_CONSOLE_TYPED - 1u)); i++) {
        answer->typed[i] = typed[first + i];
    }
}

uint32_t copter_console_line(const copter_t *copter, copter_said_t *answer,
                             char line[COPTER_CONSOLE_LINE])
{
    const command_t *found = NULL;
    const uint32_t number = answer->lines;

    for (uint32_t i = 0u; i < COMMANDS; i++) {
        if (strcmp(answer->typed, commands[i].name) == 0) {
            found = &commands[i];
        }
    }
    answer->lines++;
    return (found != NULL) ? found->line(copter, number, line)
                           : refusal_line(answer->typed, number, line);
}
