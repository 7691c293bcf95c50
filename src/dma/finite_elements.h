/* Material data for finite-element programs and the cards of each program. Internal to dma.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_DMA_FINITE_ELEMENTS_H
#define WT_DMA_FINITE_ELEMENTS_H

#include "core/table/registry.h"
#include "dma/law/material.h"
#include "weartrack/dma.h"

#include <stdio.h>

typedef struct fem_units {
    const char *words;
    double stress, time, density; /* size of the unit in Pa, s and kg/m^3 */
} fem_units;

/* Material data in the units of the file. */
typedef struct fem_material {
    FILE *out;
    const struct fem_program *program;
    const char *comment; /* start of a comment line */
    wt_rubber rubber;
    table_view series, shifts_of; /* shifts_of.table is NULL if the shift factors are unknown */
    const fem_units *unit_system;
    const wt_fem_export_options *options;
    const char *name;
    bool incompressible;
    double nu, zero;           /* Poisson's ratio; zero of the temperature unit [K] */
    double reference;          /* reference temperature */
    double instant, long_term; /* Young's moduli */
    bool shifts;               /* c1 and c2 are set */
    double c1, c2;
    double fastest;  /* storage modulus (Young's) at the highest measured frequency */
    size_t n_levels; /* number of temperature levels; 1: the moduli do not depend on temperature */
    double *level, *factor; /* temperature and the factor on the moduli there */
} fem_material;

/* A program and what it does not accept. */
typedef struct fem_program {
    const char *name;    /* in --export */
    const char *title;   /* in messages */
    const char *comment; /* start of a comment line */
    void (*write)(fem_material *s);
    size_t most_name;     /* characters of the name of the material */
    size_t most_terms;    /* of the series, with the long-term modulus as one; 0: any number */
    bool compressible;    /* needs a Poisson's ratio below 0.5 */
    bool density;         /* needs a mass density */
    bool long_term;       /* needs a long-term modulus */
    bool one_temperature; /* the cards have no shift law; the bulk modulus does not relax */
} fem_program;
enum { N_FEM_PROGRAMS = WT_FEM_TABLE + 1 };
extern const fem_program fem_programs[N_FEM_PROGRAMS];

/* Writes with a decimal point in every locale. */
void fem_write(fem_material *s, const char *format, ...) WT_PRINTF(2, 3);
/* Moduli that belong to a Young's modulus. */
double fem_shear_modulus(const fem_material *s, double young);
double fem_bulk_modulus(const fem_material *s, double young);
/* The bulk modulus of a program in which it does not relax: that of the long-term modulus, since
 * the modulus at once is an extrapolation; of the modulus at once for a liquid. */
double fem_elastic_bulk_modulus(const fem_material *s);

#endif
