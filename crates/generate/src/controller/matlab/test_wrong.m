    wrong = pose;
    wrong(1:3, 1:3) = 1.01*wrong(1:3, 1:3);
    found = @name@_ik(wrong@given_test@@parameters_passed@);
    if ~strcmp(found.status, 'not a rotation') || ~isempty(found.q) || found.off < 0.005
        error('@name@:test', '@name@_ik: what is no rotation is taken for one.');
    end
