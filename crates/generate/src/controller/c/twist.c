        double w[3], c, s;
        for (int i = 0; i < 3; i++) {
            w[i] = sin(1.0 + 2.4 * (6 * number + i));
            beside[i][3] = goal[i][3] + far * answer_size * sin(2.0 + 2.4 * (6 * number + i));
            beside[3][i] = 0.0;
        }
        beside[3][3] = 1.0;
        /* Two turns about the axes of the base. */
        c = cos(far * w[0]);
        s = sin(far * w[0]);
        for (int j = 0; j < 3; j++) {
            beside[0][j] = goal[0][j];
            beside[1][j] = c * goal[1][j] - s * goal[2][j];
            beside[2][j] = s * goal[1][j] + c * goal[2][j];
        }
        c = cos(far * w[1]);
        s = sin(far * w[1]);
        for (int j = 0; j < 3; j++) {
            const double x = beside[0][j];
            beside[0][j] = c * x + s * beside[2][j];
            beside[2][j] = c * beside[2][j] - s * x;
        }
        c = cos(far * w[2]);
        s = sin(far * w[2]);
        for (int j = 0; j < 3; j++) {
            const double x = beside[0][j];
            beside[0][j] = c * x - s * beside[1][j];
            beside[1][j] = s * x + c * beside[1][j];
        }
        return 1;