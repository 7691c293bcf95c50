/* Declares the extraction of frequency, temperature and strain sweeps from a table. Internal to
 * the text engine.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_READ_TEXT_SWEEP_H
#define WT_READ_TEXT_SWEEP_H

#include "read/text/text.h"

/* Relative difference below which two frequencies are the same; instruments hold a set frequency
 * better. */
#define SAME_FREQUENCY 0.01

typedef struct sweep_columns {
    const text_column *frequency, *storage, *loss, *magnitude, *factor, *phase, *temperature,
        *strain, *time, *step; /* `step`: relaxation modulus or creep compliance */
    double to_angular;         /* 2 pi for a frequency in Hz */
    wt_loading loading;
    wt_deformation deformation;
    bool has_storage, has_loss; /* measured or derived */
} sweep_columns;

typedef struct sweep_builder {
    const text_file *file;
    const text_table *table;
    sweep_columns c;
    const wt_read_options *options;
    wt_log *log;
    wt_sweep *sweep;
    size_t *rows; /* [n] rows of the current isotherm or temperature sweep */
    size_t n;
    bool steps; /* true to read only tables of relaxation or creep, else only others */
    bool is_frequency_missing; /* true if neither the table nor the user states a frequency */
    bool amplitudes; /* true if amplitudes alternate, so that isotherms are named by amplitude */
    size_t sample;   /* sample of the rows, or NO_SAMPLE */
    wt_error *err;
} sweep_builder;

/* ---- text_sweep_row.c */
sweep_columns sweep_find_columns(const text_table *table, wt_read_deformation stated);
/* Returns the optional arrays of the sweeps of a table, for wt_sweep_add. */
unsigned sweep_optional_arrays(const sweep_columns *c);
/* Values of a row in SI units; NaN if the column is absent. */
double sweep_loss_factor(const sweep_builder *b, size_t row);
double sweep_angular_frequency(const sweep_builder *b, size_t row);
double sweep_storage_modulus(const sweep_builder *b, size_t row);
double sweep_loss_modulus(const sweep_builder *b, size_t row);
double sweep_temperature(const sweep_builder *b, size_t row);
/* Returns 1 if the frequency increases from one row to another, -1 if it decreases, 0 if it is the
 * same. */
int sweep_direction(const sweep_builder *b, size_t from, size_t to);
/* True if the row has a frequency and all quantities that the table provides. */
bool sweep_is_valid_row(const sweep_builder *b, size_t row);
/* Formats the source as "FILE, TITLE OF THE STEP". */
void sweep_format_source(const sweep_builder *b, char *source, size_t size);
/* Sets the temperature of the rows in `b->rows` [K]: mean and standard deviation of the column, or
 * the value of the header or the user. */
wt_status sweep_set_temperature(const sweep_builder *b, double *temperature, double *spread);

/* Warns of inconsistent rows. */
void sweep_check_table(const text_file *file, text_table *table, wt_log *log);

/* Fails if the user states one temperature for tables that state different ones, and warns of
 * tables without one among them. */
wt_status sweep_check_temperatures(const text_file *file, const wt_read_options *options,
                                   wt_log *log, wt_error *err);
/* Warns if the temperature of the user applies to isotherms that differ much. */
void sweep_warn_shared_temperature(const text_file *file, const wt_read_options *options,
                                   const wt_sweep *sweep, wt_log *log);

/* ---- text_order.c: collects the rows of isotherms that do not stand together. Removes the rows of
 * strain and temperature sweeps from `rows` and adds these sweeps. ----------------------------- */
void collect_scattered_rows(sweep_builder *b, size_t *rows, size_t n);
/* True if most rows have a frequency and temperature that another sample of the table has, too. */
bool samples_repeat_grid(const sweep_builder *b);
wt_status extract_strain_sweeps(sweep_builder *b, size_t *rows, size_t *n);
void extract_ramps(sweep_builder *b, size_t *rows, size_t *n);

#endif
