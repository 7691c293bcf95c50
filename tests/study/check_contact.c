/* Friction integrals of the study against 20 digits.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"
#include "contact.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct reference_case {
    contact contact;
    rubber rubber;
    double hysteresis, area;
} reference_case;

static size_t numbers(const char *text, double *to)
{
    size_t n = 0;
    char *end;
    for (double x; n < SPECTRUM_MAX && (x = strtod(text, &end), end != text); text = end)
        to[n++] = x;
    return n;
}

static void take(char *line, reference_case *c)
{
    const struct {
        const char *start;
        double *to;
    } single[] = {{"given poisson_ratio ", &c->contact.poisson},
                  {"given equilibrium_modulus ", &c->rubber.equilibrium},
                  {"given e0 ", &c->rubber.equilibrium},
                  {"given eg ", &c->rubber.strength[0]},
                  {"given tau ", &c->rubber.tau[0]},
                  {"given alpha ", &c->rubber.alpha[0]},
                  {"given q0 ", &c->contact.q0},
                  {"given qr ", &c->contact.qr},
                  {"given q1 ", &c->contact.q1},
                  {"given hurst ", &c->contact.hurst},
                  {"given c0 ", &c->contact.c0},
                  {"given pressure ", &c->contact.pressure},
                  {"given velocity ", &c->contact.velocity[0]},
                  {"expect hysteresis ", &c->hysteresis},
                  {"expect area_ratio ", &c->area}};
    for (size_t i = 0; i < sizeof single / sizeof single[0]; i++)
        if (strncmp(line, single[i].start, strlen(single[i].start)) == 0)
            *single[i].to = strtod(line + strlen(single[i].start), NULL);
    if (strncmp(line, "given modulus ", 14) == 0)
        c->rubber.n = numbers(line + 14, c->rubber.strength);
    if (strncmp(line, "given relaxation_time ", 22) == 0)
        numbers(line + 22, c->rubber.tau);
}

static int read_case(const char *path, const char *name, reference_case *to)
{
    char line[8192], wanted[80];
    FILE *file = fopen(path, "r");
    int inside = 0, found = 0;
    *to = (reference_case){.contact = {.velocities = 1}};
    snprintf(wanted, sizeof wanted, "case %s\n", name);
    if (file == NULL)
        return 0;
    while (fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, "case ", 5) == 0)
            inside = strcmp(line, wanted) == 0;
        found |= inside;
        if (inside)
            take(line, to);
    }
    fclose(file);
    return found;
}

static void check_case(const char *path, const char *name, int steps)
{
    static reference_case c;
    char what[120];
    check_true(name, read_case(path, name, &c));
    if (c.rubber.n == 0) { /* one fractional term, up to `eg` */
        c.rubber.n = 1;
        c.rubber.strength[0] -= c.rubber.equilibrium;
        c.rubber.gamma[0] = 1;
    } else {
        for (size_t k = 0; k < c.rubber.n; k++)
            c.rubber.alpha[k] = c.rubber.gamma[k] = 1;
    }
    const rubber_state state = {.rubber = &c.rubber, .a = {1, 1}, .factor = 1};
    const contact_truth truth = contact_solve(&c.contact, &state, steps);
    snprintf(what, sizeof what, "hysteresis of %s", name);
    check_near(what, truth.hysteresis[0], c.hysteresis, 1e-6);
    snprintf(what, sizeof what, "contact area of %s", name);
    check_near(what, truth.area[0], c.area, 1e-6);
}

/* One wave: the energy decays as one exponential, and the steady-state thickness is a logarithm. */
static void check_layer(void)
{
    static const rubber plain = {
        .equilibrium = 5e6, .n = 1, .strength = {1e8}, .tau = {1e-5}, .alpha = {1}, .gamma = {1}};
    const rubber_state state = {.rubber = &plain, .a = {1, 1}, .factor = 1};
    contact c = {.q0 = 1e5,
                 .qr = 1.00005e5,
                 .q1 = 1.0001e5,
                 .hurst = 0.8,
                 .c0 = 1e-20,
                 .pressure = 1e6,
                 .poisson = 0.5,
                 .velocities = 1,
                 .velocity = {0.5},
                 .wear_rate = 1e-15,
                 .critical_energy = 1e9};
    contact_truth truth = contact_solve(&c, &state, 20);
    const double severity = truth.hysteresis[0] / (c.wear_rate * c.critical_energy);
    check_true("severity above 1", severity > 1);
    check_near("thickness under one wave", truth.thickness, log(severity) / 2.0001e5, 1e-4);
    c.wear_rate *= severity * 1.01;
    truth = contact_solve(&c, &state, 20);
    check_true("no layer where wear is faster", truth.thickness == 0);
}

void check_contact(const char *folder)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/friction.txt", folder);
    check_case(path, "normal_prony_v1e-2", 100);
    check_case(path, "fractional_zener", 100);
    check_case(path, "one_term", 100);
    check_case(path, "prony_14_decades", 100);
    check_case(path, "v_1e6", 500); /* the contact area vanishes within a few per cent of q */
    check_layer();
}
