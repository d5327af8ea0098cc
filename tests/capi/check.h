#pragma once
/* What the tests of the C door share. */

#include <stdio.h>
#include <stdlib.h>

/* Also where NDEBUG is set. */
#define CHECK(condition)                                                    \
    do {                                                                    \
        if (!(condition)) {                                                 \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
            exit(1);                                                        \
        }                                                                   \
    } while (0)

#include "faqem/faqem.h"

/* A flat grid of n x n squares over [0, n]^2, in static memory; n at most 20. */
faqem_mesh flat_grid(uint32_t n);
faqem_mesh flat_grid_of_doubles(uint32_t n);

void test_simplify(void);
void test_options(void);
void test_levels(void);
void test_asset(void);
void test_asset_levels(void);
