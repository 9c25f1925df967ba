//! Sentences about a step, each in both languages: what is eliminated, when an equation has how many values, what is lost.

use crate::explain::{Language, Words};
use crate::inverse::derivation::{Elimination, Form, Origin, Step, branch_words};

/// What the branches are called.
pub fn label(name: &str) -> Words {
    Words::new(name, branch_words(name, Language::French))
}

/// How an unknown goes out, said behind it.
pub fn elimination(how: Elimination) -> Words {
    match how {
        Elimination::Rotation => Words::new(
            " goes out when the two are solved for its terms, squared and added: the factors of its cosine and sine are those of a rotation.",
            " s'élimine en isolant ses termes dans les deux équations, puis en ajoutant leurs carrés : les facteurs de son cosinus et de son sinus sont ceux d'une rotation.",
        ),
        Elimination::Cramer => Words::new(
            " goes out when its cosine and sine are solved for by Cramer's rule; the sum of their squares is 1.",
            " s'élimine en calculant son cosinus et son sinus par la règle de Cramer ; la somme de leurs carrés vaut 1.",
        ),
        Elimination::Displacement => Words::new(
            " goes out when one is solved for it and put into the other.",
            " s'élimine : on le tire d'une équation et on le reporte dans l'autre.",
        ),
    }
}

/// An equation of a displacement whose factor vanishes.
pub fn open_displacement() -> Words {
    Words::new(
        "the equation does not determine the displacement: if the right-hand side vanishes too, it is free or another equation gives it; else no solution",
        "l'équation ne détermine pas le déplacement : si le second membre s'annule aussi, le déplacement est libre ou donné par une autre équation ; sinon, aucune solution",
    )
}

/// A root of a negative number.
pub fn out_of_reach() -> Words {
    Words::new(
        "out of reach: no solution on this branch",
        "hors d'atteinte : aucune solution sur cette branche",
    )
}

/// A distance that two links cannot span.
pub fn too_short() -> Words {
    Words::new(
        "the arm is too short, or cannot fold so far: no solution on this branch",
        "le bras est trop court, ou ne peut pas se replier autant : aucune solution sur cette branche",
    )
}

/// The roots of a quartic.
pub fn roots() -> Words {
    Words::new(
        "as many values as the polynomial has real roots t = tan(θ/2): 0, 2 or 4; a double root counts twice",
        "autant de valeurs que le polynôme a de racines réelles t = tan(θ/2) : 0, 2 ou 4 ; une racine double compte deux fois",
    )
}

/// Both coefficients of A cos + B sin = 0 vanish.
pub fn open_angle() -> Words {
    Words::new(
        "the equation leaves the angle open: it is free (the arm can move with its hand still), or another equation gives it",
        "l'équation laisse l'angle indéterminé : il est libre (le bras peut bouger sans que l'organe terminal se déplace) ou donné par une autre équation",
    )
}

/// Both coefficients of A cos + B sin = C vanish.
pub fn open_unless() -> Words {
    Words::new(
        "no solution, unless the right-hand side vanishes too: then the equation leaves the joint open",
        "aucune solution, sauf si le second membre s'annule aussi : l'équation laisse alors l'articulation indéterminée",
    )
}

/// The coefficients of two perpendicular rows vanish.
pub fn open_joint() -> Words {
    Words::new(
        "if the right-hand sides vanish too, the joint is free or another equation gives it; else no solution",
        "si les seconds membres s'annulent aussi, l'articulation est libre ou donnée par une autre équation ; sinon, aucune solution",
    )
}

/// When an equation of type 2 has two values; `less` says what else.
pub fn two_values(less: &Words) -> Words {
    Words::new(
        format!(
            "two values; they coincide where equality holds (multiplicity 2, a singular configuration); otherwise {}",
            less.english
        ),
        format!(
            "deux valeurs, confondues en cas d'égalité (multiplicité 2, configuration singulière) ; sinon, {}",
            less.french
        ),
    )
}

/// A pair of independent equations.
pub fn one_value() -> Words {
    Words::new("always exactly one value", "toujours une valeur et une seule")
}

/// A pair of dependent equations.
pub fn one_equation() -> Words {
    Words::new(
        "the two equations are one: two values, or a free joint, or none; the solver goes by the longer row",
        "les deux équations n'en font qu'une : deux valeurs, une articulation libre ou aucune solution ; le solveur retient la ligne de plus grande norme",
    )
}

/// What is lost or added on the way.
pub fn remark(step: &Step) -> Words {
    let squares = step.origins.iter().any(|o| matches!(o, Origin::Squares { .. }));
    match (&step.form, step.cost.spurious, squares) {
        (_, true, _) => Words::new(
            "The elimination may add roots that solve this equation alone; the residual of the pose sorts them out.",
            "L'élimination peut ajouter des racines de cette seule équation ; le résidu de la pose les écarte.",
        ),
        (_, false, true) => Words::new(
            "Squaring adds no root: for each value of the unknown the components give the direction that was squared away.",
            "L'élévation au carré n'ajoute aucune racine : pour chaque valeur de l'inconnue, les composantes donnent la direction que les carrés avaient fait disparaître.",
        ),
        (Form::Pair { .. } | Form::Line | Form::Sincos | Form::Ratio { .. }, ..) => Words::new(
            "Nothing is dropped, nothing is squared.",
            "Aucune équation n'est écartée, rien n'est élevé au carré.",
        ),
        _ => Words::new("No root is added.", "Aucune racine n'est ajoutée."),
    }
}
